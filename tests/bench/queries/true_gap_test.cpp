// The fast oracle against the exhaustive ones, on every adversarial family.

#include <gtest/gtest.h>

#include "tests/bench/queries/true_gap.h"
#include "tests/oracle/adversarial_pairs.h"

namespace carom::bench {
namespace {

class TrueGap : public testing::TestWithParam<int> {};

TEST_P(TrueGap, IsThatOfTheExhaustiveSearch) {
  constexpr int kMostEdges = 240;  // the exhaustive search takes their cube
  const auto family = static_cast<oracle::Family>(GetParam());
  oracle::AdversarialPairs pairs(5);
  PartPlacer placer;
  int penetrating = 0, judged = 0;
  for (int i = 0; i < 400 && judged < 40; ++i) {
    const oracle::PosedPair p = pairs.next(family);
    if (p.a->core.edgeCount() + p.b->core.edgeCount() > kMostEdges) continue;
    ++judged;
    const auto want = double(oracle::signedGap(oracle::place(*p.a, p.X_WA), oracle::place(*p.b, p.X_WB)));
    const auto got = double(trueGap(placer.at(*p.a, p.X_WA), placer.at(*p.b, p.X_WB)));
    ASSERT_NEAR(got, want, 1e-15 * (p.scale() + p.X_WA.position.norm())) << i;
    penetrating += want < 0.0;
  }
  EXPECT_GT(judged, 5);
  RecordProperty("penetrating", penetrating);
}

INSTANTIATE_TEST_SUITE_P(Families, TrueGap, testing::Range(0, static_cast<int>(oracle::Family::kCount)),
                         [](const auto& family) {
                           std::string name = oracle::familyName(static_cast<oracle::Family>(family.param));
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace carom::bench
