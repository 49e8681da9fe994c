// Sliding: the speed along a contact that presses; a wheel that rolls does not slide.

#include "engine/modes/sliding.h"

#include <gtest/gtest.h>

#include "engine/foundation/tolerances.h"
#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

// A ball of radius 0.5 over the floor's point of contact, in a general frame.
struct BallOnFloor {
  Quat frame = oracle::turned({1, 2, 3}, 0.8);
  std::vector<ImpulseBody> bodies{immovable(), {}};
  ContactRow row;

  BallOnFloor(const Vec3& velocity, const Vec3& spin, double pressing) {
    bodies[1].velocity = {frame * velocity, frame * spin};
    bodies[1].inverse_mass = 1.0;
    bodies[1].inverse_tensor = 10.0 * Mat3::Identity();
    const Vec3 n = frame * Vec3::UnitZ();
    row = rowAt({.n = n, .p_W = -0.5 * n}, bodies);
    row.impulse.x() = pressing;
  }
};

TEST(Sliding, SpeedIsTheVelocityAlongTheContact) {
  const BallOnFloor b(Vec3(3, 4, 7), Vec3(0, 0, 9), 1.0);
  EXPECT_NEAR(slidingSpeed(b.row, b.bodies), 5.0, 1e-14) << "neither lifting nor pivoting counts";
  EXPECT_TRUE(slides(b.row, b.bodies));
}

TEST(Sliding, ARollingBallDoesNot) {
  const BallOnFloor b(Vec3(3, 0, 0), Vec3(0, 6, 0), 1.0);
  EXPECT_NEAR(slidingSpeed(b.row, b.bodies), 0.0, 1e-14);
  EXPECT_FALSE(slides(b.row, b.bodies));
}

TEST(Sliding, AContactThatDoesNotPressDoesNot) {
  const BallOnFloor b(Vec3(3, 0, 0), Vec3::Zero(), 0.0);
  EXPECT_EQ(slidingSpeed(b.row, b.bodies), 0.0);
  EXPECT_FALSE(slides(b.row, b.bodies));
}

TEST(Sliding, BeginsAtItsSpeed) {
  const double v = tolerance::kSlidingSpeed;
  const BallOnFloor slow(Vec3(0, 0.99 * v, 0), Vec3::Zero(), 1.0),
      fast(Vec3(0, 1.01 * v, 0), Vec3::Zero(), 1.0);
  EXPECT_FALSE(slides(slow.row, slow.bodies));
  EXPECT_TRUE(slides(fast.row, fast.bodies));
}

}  // namespace
}  // namespace carom
