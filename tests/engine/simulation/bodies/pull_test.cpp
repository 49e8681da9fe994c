// How hard gravity and loads push bodies together.

#include "engine/simulation/bodies/pull.h"

#include <gtest/gtest.h>

#include "engine/solid/solid.h"

namespace carom {
namespace {

const Vec3 kGravity(0.0, 0.0, -10.0);

Inertia cubeOf(double mass_kg) {
  return inertiaOf(mass_kg, 1.0, Solid::box({1.0, 1.0, 1.0}).unitInertia());
}

Pull pulled(const AppliedLoad& load) {
  return pullOf(load, kGravity, cubeOf(2.0), 0.5 * std::sqrt(3.0));
}

TEST(Pull, IsGravityWhereNothingElsePushes) {
  EXPECT_EQ(pulled({}).most_mps2, 10.0);
  EXPECT_EQ(pullBetween(pulled({}), {}), 10.0) << "on what does not move";
  EXPECT_EQ(pullBetween(pulled({}), pulled({})), 10.0) << "one of them is held by something";
}

TEST(Pull, IsNothingBetweenWhatHovers) {
  const Pull hovering = pulled({.force_W = {0.0, 0.0, 20.0}});
  EXPECT_EQ(hovering.most_mps2, 0.0);
  EXPECT_EQ(pullBetween(hovering, {}), 0.0);
  EXPECT_EQ(pullBetween(hovering, hovering), 0.0);
  EXPECT_EQ(pullBetween(hovering, pulled({})), 10.0);
}

TEST(Pull, AddsUpWhereForcesPushTwoTogether) {
  const Pull right = pulled({.force_W = {30.0, 0.0, 20.0}}), left = pulled({.force_W = {-6.0, 0.0, 20.0}});
  EXPECT_EQ(right.most_mps2, 15.0);
  EXPECT_EQ(pullBetween(right, {}), 15.0);
  EXPECT_EQ(pullBetween(right, left), 18.0);
}

// A torque gives the corner of a cube of 2 kg, 0.866 m from its centre, M / I r at most.
TEST(Pull, CountsWhatTurnsTheBodyOrTurnsWithIt) {
  const double corner = 0.5 * std::sqrt(3.0) * 4.0 / (2.0 / 6.0);
  const Pull turned = pulled({.force_W = {0.0, 0.0, 20.0}, .torque_W = {0.0, 4.0, 0.0}});
  EXPECT_GE(turned.most_mps2, corner);
  EXPECT_LE(turned.most_mps2, 2.0 * corner);
  EXPECT_EQ(pullBetween(turned, turned), 2.0 * turned.most_mps2);
  EXPECT_EQ(pulled({.force_B = {0.0, 7.0, 0.0}}).most_mps2, 13.5);
}

}  // namespace
}  // namespace carom
