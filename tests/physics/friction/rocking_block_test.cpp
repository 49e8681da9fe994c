// Housner's rocking block (experiments/rocking_block.h): between landings it keeps its energy, and at each
// it keeps the closed form's share, 0.8313 for 1 x 4.
//
// GOALS' +-0.5 % is met (0.831 to 0.835) by blocks of 0.25 to 4 m, also at 30 steps a second.

#include "tests/physics/experiments/standing/rocking_block.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

TEST(RockingBlockForm, ClosedFormIsHousners) {
  EXPECT_NEAR(closedFormRockingRatio(0.25), 0.8313, 5e-5);
}

struct Block {
  double rate_hz, height_m, width_over_height;
};
void PrintTo(const Block& b, std::ostream* out) {
  *out << b.rate_hz << " Hz, " << b.height_m << " m, width / height " << b.width_over_height;
}

class RockingBlock : public testing::TestWithParam<Block> {};

TEST_P(RockingBlock, KeepsHousnersShareOfItsEnergy) {
  const Block b = GetParam();
  for (double heading : {0.0, 0.3}) {
    const std::vector<double> ratios =
        rockingRatios(kCarom, b.height_m, b.rate_hz, 3, heading, b.width_over_height);
    ASSERT_EQ(ratios.size(), 3u);
    for (double ratio : ratios)
      EXPECT_NEAR(ratio / closedFormRockingRatio(b.width_over_height), 1.0, 0.005) << heading;
  }
}

std::vector<Block> blocks() {
  std::vector<Block> blocks;
  for (double rate_hz : {30.0, 60.0, 120.0, 240.0, 1000.0})
    for (double height_m : {0.5, 1.0, 2.4, 4.0}) blocks.push_back({rate_hz, height_m, 0.25});
  for (double rate_hz : {60.0, 240.0, 1000.0}) blocks.push_back({rate_hz, 3.0, 1.0 / 3.0});
  blocks.push_back({240.0, 0.25, 0.25});
  return blocks;
}
INSTANTIATE_TEST_SUITE_P(RatesAndSizes, RockingBlock, testing::ValuesIn(blocks()));

class Swing : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, heading

// From rest to just before the landing, a block of 4 m.
TEST_P(Swing, AboutAnEdge_KeepsItsEnergy) {
  const auto [rate_hz, heading] = GetParam();
  constexpr double kHeight = 4.0;
  Trial trial = rockingBlock(kCarom, kHeight, rate_hz, heading);
  const double upright =
      trial.experiment().bodies[kRocker].mass_kg * kGravity * (0.5 * kHeight + restGap(0.25 * kHeight));
  const double begin = trial.energy() - upright;
  const auto tilt = [&] {
    return std::acos(std::min(1.0, (trial.motion(kRocker).X_WB.rotation * Vec3::UnitZ()).z()));
  };
  double last = tilt();
  for (long n = trial.stepsOf(5.0); n > 0 && last > 0.03; --n) {
    trial.step();
    last = tilt();
    if (last > 0.03) {
      ASSERT_NEAR((trial.energy() - upright) / begin, 1.0, 1e-3 * std::pow(60.0 / rate_hz, 2)) << last;
    }
  }
  EXPECT_LE(last, 0.03) << "it should have come down";
}

INSTANTIATE_TEST_SUITE_P(RatesAndHeadings, Swing,
                         testing::Combine(testing::Values(60.0, 120.0, 240.0), testing::Values(0.0, 0.7)));

}  // namespace
}  // namespace carom::physics
