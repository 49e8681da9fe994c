// A trajectory against the parabola and the rotation about a fixed axis, at any instant and any angle.

#include "engine/motion/trajectory.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

Trajectory randomPath(Random& random) {
  Trajectory path;
  path.start_s = random.uniform(-2, 2);
  path.X_WB = random.pose(5);
  path.velocity = random.uniform(0, 20) * random.direction();
  path.acceleration = random.uniform(0, 10) * random.direction();
  path.spin = random.logUniform(1e-6, 60) * random.direction();
  return path;
}

TEST(Trajectory, PositionIsTheParabola) {
  Random random(21);
  for (int i = 0; i < 1000; ++i) {
    const Trajectory path = randomPath(random);
    const double t = random.uniform(0, 3);
    const Vec3 expected = path.X_WB.position + t * path.velocity + 0.5 * t * t * path.acceleration;
    ASSERT_LT((path.at(path.start_s + t).position - expected).norm(), 1e-13)
        << i;  // some 100 m, and start_s rounds t
    ASSERT_LT((path.velocityAt(path.start_s + t) - path.velocity - t * path.acceleration).norm(), 1e-13) << i;
  }
}

TEST(Trajectory, TurnsAboutTheSpinByItsAngle_AlsoBeyondAFullTurn) {
  Random random(22);
  for (int i = 0; i < 1000; ++i) {
    const Trajectory path = randomPath(random);
    const double t = random.uniform(0, 3);
    const Quat expected =
        Quat(Eigen::AngleAxisd(t * path.spin.norm(), path.spin.normalized())) * path.X_WB.rotation;
    // The angle, up to 180 rad, is rounded where it is formed.
    ASSERT_LT(
        path.at(path.start_s + t).rotation.toRotationMatrix().isApprox(expected.toRotationMatrix(), 1e-12)
            ? 0
            : 1,
        1)
        << i;
    ASSERT_NEAR(path.at(path.start_s + t).rotation.norm(), 1.0, 4e-16);
  }
}

TEST(Trajectory, APointOfTheBodyMovesWithTheVelocityOfItsSpin) {
  Random random(23);
  const double h = 1e-5;
  for (int i = 0; i < 100; ++i) {
    Trajectory path = randomPath(random);
    path.spin = random.uniform(0, 5) * random.direction();
    const double t = path.start_s + random.uniform(0.1, 1);
    const Vec3 p_B = random.direction();
    const Vec3 slope = (path.at(t + h) * p_B - path.at(t - h) * p_B) / (2 * h);
    const Vec3 r = path.at(t).rotation * p_B;
    EXPECT_LT((slope - (path.velocityAt(t) + path.spin.cross(r))).norm(), 1e-7) << i;  // h^2 spin^3 / 6
  }
}

TEST(Trajectory, StartsExactlyWhereItIsSaidTo) {
  Random random(24);
  const Trajectory path = randomPath(random);
  EXPECT_EQ(path.at(path.start_s).position, path.X_WB.position);
  EXPECT_EQ(path.at(path.start_s).rotation.coeffs(), path.X_WB.rotation.coeffs());
}

TEST(Trajectory, TakenUpFromALaterInstantGoesOnTheSameWay) {
  Random random(25);
  for (int i = 0; i < 100; ++i) {
    const Trajectory path = randomPath(random);
    const double middle = path.start_s + random.uniform(0, 1), end = middle + random.uniform(0, 1);
    Trajectory rest = path;
    rest.start_s = middle;
    rest.X_WB = path.at(middle);
    rest.velocity = path.velocityAt(middle);
    EXPECT_LT((rest.at(end).position - path.at(end).position).norm(), 1e-13);
    EXPECT_LT(rest.at(end).rotation.angularDistance(path.at(end).rotation), 1e-7);
  }
}

TEST(Trajectory, IsStillOnlyWithoutVelocityAccelerationAndSpin) {
  Trajectory path;
  EXPECT_TRUE(path.still());
  for (Vec3 Trajectory::*member : {&Trajectory::velocity, &Trajectory::acceleration, &Trajectory::spin}) {
    Trajectory moving;
    moving.*member = Vec3(0, 1e-300, 0);
    EXPECT_FALSE(moving.still());
  }
}

}  // namespace
}  // namespace carom
