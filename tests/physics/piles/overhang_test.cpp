// The harmonic overhang of eight blocks (experiments/overhang.h) stands at 0.999 of its limit and falls at
// 1.001.
//
// At 30 steps a second blocks of less than half a metre stand at 0.995; at 0.999 some of them fall.

#include "tests/physics/experiments/standing/overhang.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class Overhang : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, block's length

TEST_P(Overhang, StandsAThousandthShortOfTheHarmonicLimit_AndFallsAThousandthBeyond) {
  const auto [rate_hz, length_m] = GetParam();
  const double stands = rate_hz > 50.0 || length_m > 1.0 ? 0.999 : 0.995;
  for (double heading : {0.0, 0.6}) {
    EXPECT_LE(overhangDrop(kCarom, stands, rate_hz, length_m, heading), 1e-3 * length_m) << heading;
    EXPECT_LE(overhangDrop(kCarom, 0.9, rate_hz, length_m, heading), 1e-3 * length_m) << heading;
    EXPECT_FALSE(overhangStands(kCarom, 1.001, rate_hz, length_m, heading)) << heading;
  }
}

INSTANTIATE_TEST_SUITE_P(RatesAndSizes, Overhang,
                         testing::Combine(testing::Values(30.0, 60.0, 120.0, 240.0),
                                          testing::Values(0.2, 0.4, 1.6)));

}  // namespace
}  // namespace carom::physics
