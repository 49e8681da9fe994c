// The least speed of a collision, in closed form at its ends.

#include "engine/contact/collision_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace carom {
namespace {

constexpr double kStep_s = 1.0 / 60.0;

Approach approach(double restitution, double pull_mps2, bool both_fall = false) {
  return {collisionWindow(1.0), restitution, pull_mps2, both_fall, kStep_s};
}

TEST(LeastCollisionSpeed, OfWhatDoesNotBounceIsThatOfAFallThroughTheWindowOrOfAStep) {
  const double g = 9.81, fall = std::sqrt(2.0 * g * collisionWindow(1.0).ceiling);
  EXPECT_DOUBLE_EQ(collisionSpeed(approach(0.0, g)), std::max(fall, 1.5 * g * kStep_s));
  const double load = 1e5;
  EXPECT_DOUBLE_EQ(collisionSpeed(approach(0.0, load)), 1.5 * load * kStep_s) << "pressed by a force";
}

TEST(LeastCollisionSpeed, OfWhatBouncesIsLessTheMoreItKeeps) {
  for (const double pull : {9.81, 1e3, 1e5}) {
    double before = collisionSpeed(approach(0.0, pull));
    for (const double e : {0.2, 0.5, 0.8, 0.95, 1.0}) {
      const double speed = collisionSpeed(approach(e, pull));
      EXPECT_LE(speed, before) << e;
      EXPECT_GE(2.0 * e * speed, pull * kStep_s / 16.0 * e) << "half a bounce lasts a 32nd of a step or more";
      EXPECT_LE(2.0 * e * speed, pull * kStep_s * (1.0 + 1e-12)) << "a bounce of a whole step is one";
      before = speed;
    }
  }
}

TEST(LeastCollisionSpeed, IsATraceWhereNothingPushesTwoTogether) {
  const double trace = collisionSpeed(approach(0.5, 0.0));
  EXPECT_GT(trace, 0.0);
  EXPECT_LT(trace, 0.01);
  EXPECT_DOUBLE_EQ(collisionSpeed(approach(1.0, 9.81, true)), collisionSpeed(approach(0.0, 0.0)));
}

}  // namespace
}  // namespace carom
