// A ball rolls by 5/7 g sin exactly when mu >= 2/7 tan (experiments/rolling_ball.h), and balls on a box that
// slides gain 2/7 of its acceleration (experiments/balls_on_a_box.h).
//
// The contact lies half a rest gap g below the ball, and r + g/2 = R takes the place of r in the lever: then
// a = g sin / (1 + 2/5 r^2/R^2), larger than 5/7 g sin by 2/7 g/r: 0.057 % up to half a metre of radius.
// GOALS wants the closed form itself; that is not met.

#include "tests/physics/experiments/rolling_ball.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/balls_on_a_box.h"
#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class RollingBall : public testing::TestWithParam<double> {};  // Hz

TEST_P(RollingBall, AcceleratesByFiveSeventhsOfGTimesSine_ButForTheGapUnderIt) {
  for (double angle_deg : {3.0, 15.0, 40.0})
    for (double heading : {0.0, 0.7, 2.3})
      for (double radius : {0.02, 0.25, 1.5}) {
        const Slope slope{
            .rate_hz = GetParam(), .angle = radians(angle_deg), .friction = 0.9, .heading = heading};
        const double lever = 1.0 + 0.5 * restGap(2.0 * radius) / radius;
        const double with_gap = 1.4 / (1.0 + 0.4 / (lever * lever)) - 1.0;
        const double error = rollingError(kCarom, slope, radius);
        SCOPED_TRACE(testing::Message() << angle_deg << " degrees, heading " << heading << ", " << radius);
        EXPECT_NEAR(error, with_gap, 1e-6);  // the gap is held to a hundredth of itself or so
        EXPECT_LE(std::abs(error), 6e-4);
      }
}

// What counts as slipping biases the threshold by 0.15 %, the gap by as much.
TEST_P(RollingBall, SlipsExactlyWhenMuIsLessThanTwoSeventhsOfTheTangent) {
  for (double angle_deg : {10.0, 35.0}) {
    const Slope slope{.rate_hz = GetParam(), .angle = radians(angle_deg), .heading = 1.1};
    EXPECT_LE(std::abs(rollingThresholdError(kCarom, slope)), 5e-3) << angle_deg;
  }
}

// The levers of the gaps are worth 2/7 x 0.2 % of 8 m/s^2 and the like over half a second: 1e-3 m/s, squared.
TEST_P(RollingBall, OnABoxThatSlides_GainsTwoSeventhsOfItsAcceleration) {
  for (double heading_deg : {0.0, 45.0, 160.0})
    EXPECT_LE(rollingVelocityError(kCarom, 1.0 / GetParam(), radians(heading_deg)), 1e-6) << heading_deg;
}

INSTANTIATE_TEST_SUITE_P(Rates, RollingBall, testing::Values(30.0, 60.0, 240.0));

}  // namespace
}  // namespace carom::physics
