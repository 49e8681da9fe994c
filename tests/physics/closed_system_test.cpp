// Balls and boxes that meet in free space with friction and restitution (experiments/closed_system.h): what
// they have of momentum stays to the rounding of some thousand impulses.
//
// GOALS wants the same of angular momentum: not met. It changes in steps with a dozen impacts and more,
// relative to the sum of its parts by 1.4e-4 at 30 steps a second and 3.1e-3 at 60. At 120 and 240 it does
// not with this friction (2e-14 and 9e-14); with others of 0.1 to 0.5 by up to 1.3e-2 at 30, 1.2e-2 at 60,
// 3.3e-3 at 120 and 1e-5 at 240.

#include "tests/physics/experiments/closed_system.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class FreeSpace : public testing::TestWithParam<double> {};  // Hz

TEST_P(FreeSpace, KeepsMomentum_ThroughFrictionAndRestitution) {
  const MomentumError error = collideInFreeSpace(kCarom, GetParam(), 5.0);
  EXPECT_LE(error.linear, 1e-12);
  EXPECT_LE(error.angular, GetParam() > 100.0 ? 1e-10 : 1e-2);
  EXPECT_GT(error.energy_lost, 0.3) << "they should have met";
}

INSTANTIATE_TEST_SUITE_P(Rates, FreeSpace, testing::Values(30.0, 60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
