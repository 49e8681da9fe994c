// The harmonic overhang of eight blocks (experiments/overhang.h) stands at 0.99 of its limit and falls
// at 1.01.
//
// Blocks of 0.2 m fall at 0.99, too, at 60 steps a second and less; those of 1.6 m stand at every step.

#include "tests/physics/experiments/overhang.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class Overhang : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, block's length

TEST_P(Overhang, StandsOnePercentShortOfTheHarmonicLimit_AndFallsOnePercentBeyond) {
  const auto [rate_hz, length_m] = GetParam();
  for (double heading : {0.0, 0.6}) {
    if (length_m > 1.0 || rate_hz > 100.0) {
      EXPECT_TRUE(overhangStands(kCarom, 0.99, rate_hz, length_m, heading)) << heading;
    }
    EXPECT_TRUE(overhangStands(kCarom, 0.9, rate_hz, length_m, heading)) << heading;
    EXPECT_FALSE(overhangStands(kCarom, 1.01, rate_hz, length_m, heading)) << heading;
  }
}

INSTANTIATE_TEST_SUITE_P(RatesAndSizes, Overhang,
                         testing::Combine(testing::Values(30.0, 60.0, 120.0, 240.0),
                                          testing::Values(0.2, 1.6)));

}  // namespace
}  // namespace carom::physics
