// Small heaps of the kind that `stress pile` drops by the thousand: they never overlap, at any friction, and
// stay in the bin.

#include "tests/bench/bin_pile.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/oracle/overlap_oracle.h"

namespace carom::bench {
namespace {

class SmallPile : public testing::TestWithParam<std::tuple<PileOf, double>> {};

TEST_P(SmallPile, NeverOverlapsAndHardlyStalls) {
  const auto [of, friction] = GetParam();
  BinPile pile({.of = of, .bodies = 27, .friction = friction});
  ASSERT_TRUE(pile.world().start().empty());
  constexpr int kSteps = 180;
  int stalled = 0;
  for (int i = 0; i < kSteps; ++i) {
    pile.world().step();
    stalled += pile.world().audit().last_step.stopped_bodies;
    ASSERT_GT(pile.world().audit().smallest_gap_m, 0.0) << "step " << i;
    if (i % 12 == 0) {
      ASSERT_GT(oracle::smallestGap(pile.world()).gap_m, 0.0) << "step " << i;
    }
  }
  EXPECT_EQ(pile.escaped(), 0);
  EXPECT_LT(stalled, 1e-3 * pile.plan().bodies * kSteps);
}

INSTANTIATE_TEST_SUITE_P(KindsAndFriction, SmallPile,
                         testing::Combine(testing::Values(PileOf::kHulls, PileOf::kBoxes),
                                          testing::Values(0.5, 0.1, 0.0)),
                         [](const auto& pile) {
                           const bool hulls = std::get<0>(pile.param) == PileOf::kHulls;
                           return std::string(hulls ? "Hulls" : "Boxes") + "AtFriction" +
                                  std::to_string(std::lround(10.0 * std::get<1>(pile.param))) + "Tenths";
                         });

}  // namespace
}  // namespace carom::bench
