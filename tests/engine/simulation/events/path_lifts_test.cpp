// Who pays for what led paths have lifted: energies before and after.

#include "engine/simulation/events/path_lifts.h"

#include <gtest/gtest.h>

#include <vector>

namespace carom {
namespace {

FlightPlanner plannerOf(const std::vector<AppliedLoad>& loads) {
  WorldSettings settings;
  settings.gravity = {0.0, 0.0, -10.0};
  FlightPlanner planner(settings);
  for (const AppliedLoad& load : loads) planner.add(load, std::nullopt);
  return planner;
}

Body bodyAt(double mass_kg, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  Body body;
  body.inertia = inertiaOf(mass_kg, 1.0, Solid::box({1.0, 1.0, 1.0}).unitInertia());
  body.velocity = {velocity, spin};
  return body;
}

double energyOf(const Body& body) {
  return kineticEnergy(body.inertia, body.X_WB.rotation, body.velocity);
}

void pay(std::vector<Body>& bodies, const std::vector<std::pair<int, int>>& led,
         const AppliedLoad& load = {}) {
  PathLifts lifts;
  lifts.begin(bodies.size());
  for (const auto& [a, b] : led) lifts.join(a, b, bodies);
  std::vector<int> all;
  for (std::size_t i = 0; i < bodies.size(); ++i) all.push_back(static_cast<int>(i));
  lifts.pay(bodies, all, plannerOf(std::vector<AppliedLoad>(bodies.size(), load)));
}

TEST(PathLifts, TheFallingSpeedPaysToTheJoule) {
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, -2.0}, {0.0, 1.0, 0.0})};
  bodies[0].lift = 1.5;  // J/kg
  const double before = energyOf(bodies[0]);
  pay(bodies, {});
  EXPECT_NEAR(energyOf(bodies[0]), before - 2.0 * 1.5, 1e-12);
  EXPECT_NEAR(bodies[0].velocity.linear.z(), -1.0, 1e-12);
  EXPECT_EQ(bodies[0].velocity.linear.x(), 3.0);
  EXPECT_EQ(bodies[0].lift, 0.0);
}

TEST(PathLifts, WhatLoadsPullAlongPays) {
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, -2.0})};
  bodies[0].lift = 2.5;                             // J/kg
  pay(bodies, {}, {.force_W = {12.0, 0.0, 20.0}});  // and bears its weight
  EXPECT_NEAR(bodies[0].velocity.linear.x(), 2.0, 1e-12);
  EXPECT_EQ(bodies[0].velocity.linear.z(), -2.0);
}

TEST(PathLifts, WhatFallingCannotPayTheRestOfTheMotionDoes) {
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, -1.0}, {0.0, 1.0, 0.0}), bodyAt(1.0, Vec3::Zero())};
  bodies[0].lift = bodies[1].lift = 1.5;
  const double before = energyOf(bodies[0]);
  pay(bodies, {});
  EXPECT_NEAR(energyOf(bodies[0]), before - 2.0 * 1.5, 1e-12);
  EXPECT_EQ(bodies[1].velocity.linear, Vec3(Vec3::Zero())) << "what lies has nothing to pay with";
}

TEST(PathLifts, BodiesThatLedEachOtherPayTogether) {
  std::vector<Body> bodies{bodyAt(1.0, {0.0, 0.0, -3.0}), bodyAt(4.0, {0.0, 0.0, -3.0})};
  bodies[0].lift = 4.0;
  bodies[1].lift = -1.0;
  std::vector<Body> alone = bodies;
  pay(bodies, {{0, 1}});
  EXPECT_EQ(bodies[0].velocity.linear.z(), -3.0) << "the other was lowered by as much";
  pay(alone, {});
  EXPECT_NEAR(alone[0].velocity.linear.z(), -1.0, 1e-12);
  EXPECT_EQ(alone[1].velocity.linear.z(), -3.0) << "being lowered gives nothing";
}

}  // namespace
}  // namespace carom
