// A ball rolls by 5/7 g sin exactly when mu >= 2/7 tan, and with less it slides by g (sin - mu cos)
// (experiments/rolling_ball.h), in a groove by less (experiments/groove_ball.h); it comes up a step
// (experiments/step_ball.h); balls on a box that slides gain 2/7 of its acceleration
// (experiments/balls_on_a_box.h).
//
// All are met to rounding: 4e-13 for the smallest ball, a mean square of 4e-17 (m/s)^2 on the box.

#include "tests/physics/experiments/rolling_ball.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"
#include "tests/physics/experiments/groove_ball.h"
#include "tests/physics/experiments/standing/balls_on_a_box.h"
#include "tests/physics/experiments/step_ball.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class RollingBall : public testing::TestWithParam<double> {};  // Hz

TEST_P(RollingBall, AcceleratesByFiveSeventhsOfGTimesSine) {
  for (double angle_deg : {3.0, 15.0, 40.0})
    for (double heading : {0.0, 0.7, 2.3})
      for (double radius : {0.02, 0.25, 1.5}) {
        const Slope slope{
            .rate_hz = GetParam(), .angle = radians(angle_deg), .friction = 0.9, .heading = heading};
        SCOPED_TRACE(testing::Message() << angle_deg << " degrees, heading " << heading << ", " << radius);
        EXPECT_LE(std::abs(rollingError(kCarom, slope, radius)), 1e-11);
        EXPECT_LE(slipShare(kCarom, slope, radius), 1e-11) << "it rolls by its radius";
      }
}

TEST_P(RollingBall, GoesHalfTheAccelerationTimesTheSquareOfTime) {
  for (double radius : {0.05, 0.5, 2.0}) {
    const Slope slope{.rate_hz = GetParam(), .angle = radians(25.0), .friction = 0.9, .heading = 0.4};
    Trial trial = ballOn(slope, kCarom, radius);
    const Vec3 begin = trial.position(kOnSlope);
    trial.run(2.0);
    const double way = 2.0 * 5.0 / 7.0 * kGravity * std::sin(slope.angle);
    EXPECT_NEAR((trial.position(kOnSlope) - begin).norm() / way, 1.0, 1e-9) << radius;
  }
}

// From rest, in resting mode: a ball touches where it is lowest, to rounding, so the faintest slope counts.
TEST_P(RollingBall, RestsOnNoSlope) {
  constexpr double kSlope = 1e-4, kBallRadius = 0.2;
  SmallWorld w(GetParam());
  const Quat tilt = oracle::turned(Vec3::UnitY(), std::atan(kSlope));
  w.addPlane(rubbing(0.5), tilt);
  const Vec3 centre = tilt * Vec3(0.0, 0.0, kBallRadius + restGap(2.0 * kBallRadius));
  const int ball =
      w.add({Solid::ball(kBallRadius), {Quat::Identity(), centre}, Vec3::Zero(), Vec3::Zero(), rubbing(0.5)});
  w.start();
  w.run(3.0);
  EXPECT_FALSE(w.rests(ball));
  EXPECT_NEAR(w.velocity(ball).norm() / (3.0 * 5.0 / 7.0 * kGravity * kSlope), 1.0, 1e-6);
}

// Friction short of what rolling takes by a share d leaves d / (1 - 2/7 (1 - d)) of slip.
TEST_P(RollingBall, SlipsExactlyWhenMuIsLessThanTwoSeventhsOfTheTangent) {
  for (double angle_deg : {10.0, 35.0}) {
    Slope slope{.rate_hz = GetParam(), .angle = radians(angle_deg), .heading = 1.1};
    const double threshold = 2.0 / 7.0 * std::tan(slope.angle);
    slope.friction = (1.0 + 1e-9) * threshold;
    EXPECT_LE(slipShare(kCarom, slope), 1e-12) << angle_deg;
    for (double missing : {1e-6, 1e-3, 0.5}) {
      slope.friction = (1.0 - missing) * threshold;
      const double slip = missing / (1.0 - 2.0 / 7.0 * (1.0 - missing));
      EXPECT_NEAR(slipShare(kCarom, slope) / slip, 1.0, 1e-6) << angle_deg << " degrees, " << missing;
    }
  }
}

TEST_P(RollingBall, WithTooLittleFriction_SlidesByTheBlocksClosedForm) {
  for (double angle_deg : {10.0, 35.0}) {
    Slope slope{.rate_hz = GetParam(), .angle = radians(angle_deg), .heading = 0.4};
    slope.friction = 0.5 * 2.0 / 7.0 * std::tan(slope.angle);
    const double cosine = std::cos(slope.angle);
    const double speed = kGravity * (std::sin(slope.angle) - slope.friction * cosine);
    const double rim = 2.5 * slope.friction * kGravity * cosine;  // r alpha = mu g cos r^2 / (2/5 r^2)
    Trial trial = ballOn(slope, kCarom, 0.1);
    trial.run(1.0);
    EXPECT_NEAR(trial.velocity(kOnSlope).norm(), speed, 1e-9 * speed) << angle_deg;
    EXPECT_NEAR(0.1 * trial.spin(kOnSlope).norm(), rim, 1e-9 * rim) << angle_deg;
  }
}

TEST_P(RollingBall, OnABoxThatSlides_GainsTwoSeventhsOfItsAcceleration) {
  for (double heading_deg : {0.0, 45.0, 160.0})
    EXPECT_LE(rollingVelocityError(kCarom, 1.0 / GetParam(), radians(heading_deg)), 1e-12) << heading_deg;
}

TEST_P(RollingBall, InAGroove_TurnsAboutTheLineThroughItsContacts) {
  for (double opening_deg : {5.0, 30.0, 60.0, 75.0})
    for (double radius : {0.02, 0.4}) {
      const Slope slope{.rate_hz = GetParam(), .angle = radians(20.0), .friction = 1.5, .heading = 0.7};
      EXPECT_LE(std::abs(grooveError(kCarom, slope, radians(opening_deg), radius)), 1e-11)
          << opening_deg << " degrees, radius " << radius;
    }
}

// A gap g at the floor and at the edge turns the normal: each puts cos = 1 - h / r off by g / r, and what is
// left of the speed by 5/7 of it.
TEST_P(RollingBall, ComesUpAStepWithTheSpeedThatItsAngularMomentumLeaves) {
  for (double height : {0.1, 0.2, 0.3})
    for (double radius : {0.05, 0.5}) {
      const StepBall ball{.rate_hz = GetParam(), .radius_m = radius, .height = height, .heading = 0.6};
      SCOPED_TRACE(testing::Message() << height << " radii of " << radius << " m");
      const double off = 5.0 / 7.0 * restGap(2.0 * radius) / radius, share = 1.2;
      EXPECT_LT(speedAfterStep(kCarom, ball, 1.0 - 2.0 * off), 0.0);
      EXPECT_GT(speedAfterStep(kCarom, ball, 1.0 + 2.0 * off), 0.0);
      const double gain = share * share / (share * share - 1.0);  // of its share: the step takes the rest
      EXPECT_NEAR(speedAfterStep(kCarom, ball, share) / ball.speedAbove(share), 1.0, 2.0 * gain * off);
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, RollingBall, testing::Values(30.0, 60.0, 240.0, 1000.0));

}  // namespace
}  // namespace carom::physics
