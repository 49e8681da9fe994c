// What counts as a path that solvers may lead a body along: against energies worked out by hand.

#include "engine/simulation/bodies/path_change.h"

#include <gtest/gtest.h>

#include <array>

namespace carom {
namespace {

ImpulseBody ballAt(double mass_kg, const Velocity& v) {
  ImpulseBody body;
  body.velocity = v;
  body.inverse_mass = 1.0 / mass_kg;
  body.inverse_tensor = Mat3::Identity() / (0.4 * mass_kg);  // radius 1 m
  return body;
}

TEST(PathChange, TwiceTheEnergyIsThatOfTheFormula) {
  const Velocity v{{1.0, 2.0, -2.0}, {0.0, 3.0, 4.0}};
  EXPECT_NEAR(twiceEnergy(ballAt(5.0, {}), v), 5.0 * 9.0 + 2.0 * 25.0, 1e-12);
  ImpulseBody fixed = ballAt(5.0, {});
  fixed.inverse_mass = 0.0;
  fixed.inverse_tensor.setZero();
  EXPECT_EQ(twiceEnergy(fixed, v), 0.0);
  ImpulseBody on_an_axle = ballAt(5.0, {});
  on_an_axle.inverse_tensor = Vec3::UnitZ() * Vec3::UnitZ().transpose() / 2.0;
  EXPECT_NEAR(twiceEnergy(on_an_axle, {Vec3::Zero(), {0.0, 0.0, 3.0}}), 2.0 * 9.0, 1e-12);
}

TEST(PathChange, StandingStillAndWhatIsNearerAreNear) {
  const std::array before{ballAt(2.0, {{0.0, 0.0, -1.0}, Vec3::Zero()})};
  const auto ledTo = [&](const Vec3& velocity) {
    return staysNear(before, std::array{ballAt(2.0, {velocity, Vec3::Zero()})});
  };
  EXPECT_TRUE(ledTo(Vec3::Zero()));
  EXPECT_TRUE(ledTo({0.3, 0.0, -0.5}));
  EXPECT_TRUE(ledTo({0.0, 0.0, 0.004})) << "opening a gap at up to 0.1 m/s, in the measure of energy";
  EXPECT_FALSE(ledTo({0.0, 0.0, 0.1}));
  EXPECT_FALSE(ledTo({200.0, 0.0, 0.0}));
}

TEST(PathChange, AHeavyBodyThatOpensAGapMayMoveALightOne) {
  const std::array before{ballAt(1000.0, {}), ballAt(1.0, {})};
  EXPECT_TRUE(
      staysNear(before, std::array{ballAt(1000.0, {}), ballAt(1.0, {{3.0, 0.0, 0.0}, Vec3::Zero()})}));
  EXPECT_FALSE(
      staysNear(before, std::array{ballAt(1000.0, {}), ballAt(1.0, {{4.0, 0.0, 0.0}, Vec3::Zero()})}));
}

}  // namespace
}  // namespace carom
