// Carom among the libraries: the features are tracked from query to query, as the engine's pair table does.

#include "tests/bench/peers/carom_query.h"

namespace carom::bench {

Library caromLibrary();

namespace {

class CaromPair : public PairQuery {
 public:
  CaromPair(const ConvexPart& a, const ConvexPart& b) : a_(a), b_(b) {}

  void setPoses(std::span<const PosePair> poses) override {
    X_WA_.clear();
    X_WB_.clear();
    for (const PosePair& pair : poses) {
      X_WA_.push_back(posed(pair.X_WA));
      X_WB_.push_back(posed(pair.X_WB));
    }
    forget();
  }
  void forget() override { bench::forget(memory_); }
  double ask(std::size_t i) override { return bench::ask(a_, X_WA_[i], b_, X_WB_[i], memory_).distance_m; }

 private:
  const ConvexPart& a_;
  const ConvexPart& b_;
  std::vector<Pose> X_WA_, X_WB_;
  Memory memory_;
};

}  // namespace

Library caromLibrary() {
  return {"carom", Gives::kDistance, 1e-12, [](const Hull& a, const Hull& b) -> std::unique_ptr<PairQuery> {
            return std::make_unique<CaromPair>(*a.part, *b.part);
          }};
}

}  // namespace carom::bench
