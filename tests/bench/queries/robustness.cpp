// Wrong answers of each library on the same adversarial pairs: robustness [--pairs N] [--seed S]. The truth
// is our answer where its certificate proves it to 1e-12 of the pair's scale, else the exhaustive oracle in
// long double. Ours is wrong when its distance or depth is off by more than 1e-12, or its normal or witnesses
// by more than 1e-7 (the distance is flat where features are almost parallel, so that rounding leaves them
// its square root); each such pair is told on stderr. A peer is wrong when its distance is off by more than
// its own tolerance (1e-6 in double, 1e-4 in float). ODE, which gives no distance, is asked only whether the
// pair touches. A failure is an exception, a failed assertion, no result, or a number that is not finite.
// Exit code 1 when ours has either.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string_view>

#include "tests/bench/peers/carom_query.h"
#include "tests/bench/queries/true_gap.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/witness_certificate.h"

namespace carom::bench {
namespace {

using oracle::Family;
using oracle::PosedPair;

constexpr double kOurs = 1e-12;      // of the pair's scale
constexpr double kDirection = 1e-7;  // the same, for normals and witnesses

struct Tally {
  int asked = 0;
  int wrong = 0;
  int failed = 0;
  double largest = 0.0;  ///< Relative error.

  void count(double error, double tolerance) {
    ++asked;
    if (!std::isfinite(error)) {
      ++failed;
      return;
    }
    wrong += error > tolerance;
    largest = std::max(largest, error);
  }
  void add(const Tally& other) {
    asked += other.asked;
    wrong += other.wrong;
    failed += other.failed;
    largest = std::max(largest, other.largest);
  }
};

struct Verdict {
  double truth_m = 0.0;
  double error = 0.0;      ///< Of our distance, relative to the scale.
  double direction = 0.0;  ///< Of our normal and witnesses, likewise.
};

// The truth about a pair, and our errors.
Verdict judge(const JudgedPart& a, const JudgedPart& b, const ClosestFeatures& c, double scale) {
  const oracle::ClaimedAnswer claim{c.distance_m, c.p_A_W.cast<Real>(), c.p_B_W.cast<Real>(),
                                    c.n_W.cast<Real>()};
  const auto certified = double(oracle::separationError(a.placed, b.placed, claim)) / scale;
  if (c.distance_m > 0.0 && certified <= kOurs) return {c.distance_m, certified, certified};
  const Real freed = gapAlong(a.placed, b.placed, claim.n) - a.placed.radius_m - b.placed.radius_m;
  const auto truth = double(std::max(trueGap(a, b), freed));  // no direction shows more than the truth
  const double direction = c.distance_m > 0.0 ? certified : std::abs(double(freed) - c.distance_m) / scale;
  return {truth, std::abs(truth - c.distance_m) / scale, direction};
}

// A peer's relative error; for one that only tells touching from apart, the gap it is on the wrong side of.
double peerError(const Library& library, double answer_m, double truth_m, double scale) {
  if (library.gives == Gives::kDistance) return std::abs(answer_m - truth_m) / scale;
  if (std::isnan(answer_m)) return answer_m;
  const bool says_apart = answer_m == kApart;
  return says_apart == (truth_m > 0.0) ? 0.0 : std::abs(truth_m) / scale;
}

class Robustness {
 public:
  explicit Robustness(std::uint64_t seed) : pairs_(seed), libraries_(libraries()) {}

  int run(int pairs);

 private:
  struct Row {
    std::vector<Tally> tallies;
    double slowest_us = 0.0;
  };
  Row runFamily(Family family, int pairs);
  void askPeers(const PosedPair& p, const Verdict& verdict, double scale, Row& row);
  ClosestFeatures askOurs(const PosedPair& p, double& slowest_us);
  PairQuery& peer(std::size_t library, const PosedPair& p);
  void printRow(const char* name, const Row& row) const;

  oracle::AdversarialPairs pairs_;
  std::vector<Library> libraries_;
  PartPlacer placer_;
  Memory memory_{};
  double direction_ = 0.0;  ///< The largest error of our normals and witnesses.
  int limits_ = 0;          ///< Our walks that reached their bound and were answered by search.
  using Key = std::tuple<std::size_t, const ConvexPart*, const ConvexPart*>;
  std::map<Key, std::unique_ptr<PairQuery>> peers_;
};

// From a cold start. A slow one is asked again and counts as its fastest: the machine may have been busy.
ClosestFeatures Robustness::askOurs(const PosedPair& p, double& slowest_us) {
  constexpr int kRepeats = 5;
  double us = kApart;
  ClosestFeatures c;
  for (int i = 0; i < kRepeats && us > slowest_us; ++i) {
    forget(memory_);
    const auto start = std::chrono::steady_clock::now();
    c = ask(*p.a, p.X_WA, *p.b, p.X_WB, memory_);
    us = std::min(
        us, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  slowest_us = std::max(slowest_us, us);
  return c;
}

PairQuery& Robustness::peer(std::size_t library, const PosedPair& p) {
  std::unique_ptr<PairQuery>& query = peers_[{library, p.a, p.b}];
  if (!query) query = libraries_[library].makePair(plain(*p.a), plain(*p.b));
  return *query;
}

void Robustness::askPeers(const PosedPair& p, const Verdict& verdict, double scale, Row& row) {
  const auto polyhedron = [](const ConvexPart& part) {
    return part.core.faceCount() > 0 && part.radius_m == 0.0;
  };
  if (!polyhedron(*p.a) || !polyhedron(*p.b)) return;
  const PosePair poses{plain(p.X_WA), plain(p.X_WB)};
  for (std::size_t k = 1; k < libraries_.size(); ++k) {
    PairQuery& query = peer(k, p);
    query.setPoses({&poses, 1});
    const double error = peerError(libraries_[k], query.ask(0), verdict.truth_m, scale);
    row.tallies[k].count(error, libraries_[k].tolerance);
  }
}

Robustness::Row Robustness::runFamily(Family family, int pairs) {
  Row row{std::vector<Tally>(libraries_.size()), 0.0};
  for (int i = 0; i < pairs; ++i) {
    const PosedPair p = pairs_.next(family);
    const double scale = p.scale();
    const ClosestFeatures c = askOurs(p, row.slowest_us);
    limits_ += c.reached_limit;
    const Verdict verdict = judge(placer_.at(*p.a, p.X_WA), placer_.at(*p.b, p.X_WB), c, scale);
    direction_ = std::max(direction_, verdict.direction);
    const bool turned_wrong = verdict.direction > kDirection;
    row.tallies[0].count(verdict.error, turned_wrong ? -1.0 : kOurs);
    if (!(verdict.error <= kOurs) || turned_wrong)
      std::fprintf(stderr, "ours, %s pair %d: distance %.3g off by %.1e, normal and witnesses by %.1e\n",
                   oracle::familyName(family), i, c.distance_m, verdict.error, verdict.direction);
    askPeers(p, verdict, scale, row);
  }
  return row;
}

void Robustness::printRow(const char* name, const Row& row) const {
  std::printf("%-16s%7d", name, row.tallies[0].asked);
  for (const Tally& tally : row.tallies)
    if (tally.asked > 0)
      std::printf(" |%6d%6d  %.0e", tally.wrong, tally.failed, tally.largest);
    else
      std::printf(" |%6s%6s%7s", "-", "-", "-");
  std::printf(" |%8.1f\n", row.slowest_us);
  std::fflush(stdout);
}

int Robustness::run(int pairs) {
  std::printf("%-16s%7s", "", "");
  for (const Library& library : libraries_)
    std::printf(" |%-11s > %.0e", (" " + library.name).c_str(), library.tolerance);
  std::printf(" | slowest\n%-16s%7s", "family", "pairs");
  for (std::size_t k = 0; k < libraries_.size(); ++k) std::printf(" |%6s%6s%7s", "wrong", "fail", "most");
  std::printf(" | ours us\n");
  Row all{std::vector<Tally>(libraries_.size()), 0.0};
  constexpr int kFamilies = static_cast<int>(Family::kCount);
  for (int f = 0; f < kFamilies; ++f) {
    const int share = pairs / kFamilies + (f < pairs % kFamilies ? 1 : 0);
    const Row row = runFamily(static_cast<Family>(f), share);
    printRow(oracle::familyName(static_cast<Family>(f)), row);
    for (std::size_t k = 0; k < libraries_.size(); ++k) all.tallies[k].add(row.tallies[k]);
    all.slowest_us = std::max(all.slowest_us, row.slowest_us);
  }
  printRow("all", all);
  std::printf("ours: normals and witnesses within %.0e, answered by exhaustive search %d\n", direction_,
              limits_);
  return all.tallies[0].wrong + all.tallies[0].failed > 0 ? 1 : 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  long pairs = 52000, seed = 1;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view option = argv[i];
    char* end = nullptr;
    const long value = i + 1 < argc ? std::strtol(argv[i + 1], &end, 10) : -1;
    const bool number =
        end != nullptr && end != argv[i + 1] && *end == '\0' && value >= 0 && value <= 1000000000;
    if (!number || (option != "--pairs" && option != "--seed")) {
      std::fprintf(stderr, "usage: robustness [--pairs N] [--seed S]\n");
      return 2;
    }
    (option == "--pairs" ? pairs : seed) = value;
  }
  return carom::bench::Robustness(static_cast<std::uint64_t>(seed)).run(static_cast<int>(pairs));
}
