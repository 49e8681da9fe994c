// What bodies are given in flight, asked of the planner itself.

#include "engine/simulation/bodies/flight_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// Slender bodies that tumble through air, some of them lying on others before the blow that gives them this
// velocity. It changes both their angular momentum and their energy of turning as flight does; with the
// momentum alone, taken in the orientation that they have now, a body would have another energy.
TEST(FlightPlanner, WhatIsStruckGainsAsInFlight_HoweverItTravelledBefore) {
  constexpr double kStep = 1.0 / 60.0;
  WorldSettings settings{.step_s = kStep};
  settings.air.density_kgpm3 = 1.2;
  const Solid solid = Solid::box({0.3, 0.02, 0.01});
  FlightPlanner planner(settings);
  planner.add({}, std::nullopt);
  planner.begin(std::span(&solid, 1), {0});
  planner.beginStep(0.0, kStep);
  oracle::Random random(411);
  Body body;
  body.inertia = inertiaOf(700.0, solid.volume(), solid.unitInertia());
  body.radius_m = 0.16;
  double most_beside = 0.0;
  for (int i = 0; i < 50; ++i) {
    SCOPED_TRACE(i);
    body.path.X_WB = random.pose(1.0);
    const Velocity struck{5.0 * random.direction(), 20.0 * random.direction()};
    body.travel = Travel::kBallistic;
    const Velocity in_flight = planner.gainedFrom(0, body, 0.0, struck);
    body.travel = Travel::kCarried;
    const Velocity carried = planner.gainedFrom(0, body, 0.0, struck);
    EXPECT_EQ(carried.linear, in_flight.linear);
    EXPECT_EQ(carried.angular, in_flight.angular);
    Body flying = body;
    flying.travel = Travel::kBallistic;
    flying.momentum_velocity = struck;
    planner.plan(0, flying);
    ASSERT_TRUE(flying.turning_power.has_value());
    const Quat& R_WB = body.path.X_WB.rotation;
    const auto energyOf = [&](const Vec3& spin) {
      return 0.5 * spin.dot(angularMomentum(body.inertia, R_WB, spin));
    };
    const double energy = energyOf(struck.angular) + kStep * *flying.turning_power;
    EXPECT_NEAR(energyOf(struck.angular + carried.angular), energy, 1e-9 * energy);
    const Vec3 by_momentum = angularVelocity(body.inertia, R_WB, kStep * flying.torque);
    most_beside = std::max(most_beside, std::abs(energyOf(struck.angular + by_momentum) / energy - 1.0));
  }
  EXPECT_GT(most_beside, 1e-3) << "none of them shows the difference";
}

}  // namespace
}  // namespace carom
