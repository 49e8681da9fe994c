// The approach test: u = n . (v_B - v_A) is the rate at which the distance of two bodies grows.

#include "engine/contact/approach.h"

#include <gtest/gtest.h>

#include "engine/closest_features/vclip.h"
#include "engine/motion/trajectory.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(SeparatingSpeed, IsNegativeWhenTheBodiesApproach) {
  const Vec3 a(0, 0, 0), b(3, 0, 0), between(1.5, 0, 0), n(1, 0, 0);
  const Velocity still, forwards{Vec3(2, 0, 0), Vec3::Zero()}, backwards{Vec3(-2, 0, 0), Vec3::Zero()};
  EXPECT_EQ(separatingSpeed(forwards, a, still, b, between, n), -2.0);
  EXPECT_EQ(separatingSpeed(still, a, forwards, b, between, n), 2.0);
  EXPECT_EQ(separatingSpeed(still, a, backwards, b, between, n), -2.0);
  EXPECT_EQ(separatingSpeed(forwards, a, forwards, b, between, n), 0.0);
}

TEST(SeparatingSpeed, OfTwoThatMoveAsOneBodyIsZero) {
  Random random(51);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = 5 * random.direction(), v = random.direction(), a = random.direction(),
               b = 3 * random.direction(), p = 2 * random.direction();
    EXPECT_NEAR(separatingSpeed({v + w.cross(a), w}, a, {v + w.cross(b), w}, b, p, random.direction()), 0.0,
                1e-13);
  }
}

TEST(SeparatingSpeed, DoesNotChangeWhenTheBodiesAreNamedTheOtherWayRound) {
  Random random(52);
  const Velocity v_a{random.direction(), random.direction()}, v_b{random.direction(), random.direction()};
  const Vec3 a = random.direction(), b = random.direction(), p = random.direction(), n = random.direction();
  EXPECT_DOUBLE_EQ(separatingSpeed(v_a, a, v_b, b, p, n), separatingSpeed(v_b, b, v_a, a, p, -n));
}

// Balls and a box: the witness on a face moves along it, but the distance changes by the normal speed alone.
TEST(SeparatingSpeed, IsTheSlopeOfTheDistance) {
  Random random(53);
  const Solid box = Solid::box({1, 0.7, 0.5}), ball = Solid::ball(0.2);
  const double h = 1e-6;
  int tried = 0;
  for (int i = 0; i < 500; ++i) {
    Trajectory a, b;
    a.X_WB = random.pose(0.1);
    b.X_WB = {random.rotation(), random.uniform(1.2, 3) * random.direction()};
    for (Trajectory* path : {&a, &b}) {
      path->velocity = random.uniform(0, 5) * random.direction();
      path->spin = random.uniform(0, 5) * random.direction();
    }
    const auto closestAt = [&](double t) {
      FeaturePair cold;
      return closestFeatures(box.parts()[0], a.at(t), ball.parts()[0], b.at(t), cold);
    };
    const ClosestFeatures now = closestAt(0), before = closestAt(-h), after = closestAt(h);
    if (now.status != Separation::kSeparated || !(before.features == after.features)) continue;
    ++tried;
    const double u = separatingSpeed({a.velocity, a.spin}, a.X_WB.position, {b.velocity, b.spin},
                                     b.X_WB.position, 0.5 * (now.p_A_W + now.p_B_W), now.n_W);
    // At the midpoint n . (w x r) equals its value at either witness, since the witnesses differ along n.
    EXPECT_NEAR(u, (after.distance_m - before.distance_m) / (2 * h), 1e-6) << i;
  }
  EXPECT_GT(tried, 400);
}

}  // namespace
}  // namespace carom
