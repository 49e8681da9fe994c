// Balls and boxes that meet in free space with friction and restitution (experiments/closed_system.h): what
// they have of momentum stays to the rounding of some thousand impulses.
//
// Angular momentum, too (closed_islands.h): where bodies stay in contact while they turn their paths are led,
// which moves a momentum aside. Where nothing bounces, those that turn almost as one have no energy to be led
// together by, and change it by up to 1e-4.

#include "tests/physics/experiments/closed_system.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class FreeSpace : public testing::TestWithParam<double> {};  // Hz

TEST_P(FreeSpace, KeepsMomentum_ThroughFrictionAndRestitution) {
  const MomentumError error = collideInFreeSpace(kCarom, GetParam(), 5.0);
  EXPECT_LE(error.linear, 1e-12);
  EXPECT_LE(error.angular, 1e-12);
  EXPECT_GT(error.energy_lost, 0.3) << "they should have met";
}

INSTANTIATE_TEST_SUITE_P(Rates, FreeSpace, testing::Values(30.0, 60.0, 120.0, 240.0));

class LastingContactInSpace : public testing::TestWithParam<double> {};  // friction

TEST_P(LastingContactInSpace, KeepsAngularMomentum) {
  const MomentumError error = collideInFreeSpace(kCarom, 60.0, 5.0, GetParam(), 0.0);
  EXPECT_LE(error.linear, 1e-12);
  EXPECT_LE(error.angular, 1e-4);
  EXPECT_GT(error.energy_lost, 0.3) << "they should have met";
}

INSTANTIATE_TEST_SUITE_P(Frictions, LastingContactInSpace, testing::Values(0.0, 0.1, 0.3, 0.5, 1.0));

}  // namespace
}  // namespace carom::physics
