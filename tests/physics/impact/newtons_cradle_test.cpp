// Newton's cradle: one ball in, one ball out (experiments/newtons_cradle.h), whether the balls touch or not,
// at any step, size and heading. A few roundings of speeds of one are left.

#include "tests/physics/experiments/newtons_cradle.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class Cradle : public testing::TestWithParam<double> {};  // Hz

TEST_P(Cradle, OfTouchingBalls_HandsTheBlowToTheLast) {
  for (double radius : {0.02, 0.1, 0.7})
    for (double heading : {0.0, 0.7, 1.9})
      EXPECT_LE(cradleError(cradleSpeeds(kCarom, restGap(2.0 * radius), GetParam(), radius, heading)), 1e-12)
          << "radius " << radius << " heading " << heading;
}

TEST_P(Cradle, OfSeparatedBalls_HandsTheBlowToTheLast) {
  for (double gap_m : {0.002, 0.01, 0.1})
    EXPECT_LE(cradleError(cradleSpeeds(kCarom, gap_m, GetParam(), 0.1, 0.7)), 1e-12) << "gap " << gap_m;
}

INSTANTIATE_TEST_SUITE_P(Rates, Cradle, testing::Values(30.0, 60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
