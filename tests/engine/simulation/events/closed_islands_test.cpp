// Angular momentum of bodies that only meet each other: what led paths took from it is given back, without
// momentum and without energy.

#include "engine/simulation/events/closed_islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace carom {
namespace {

struct Sums {
  Vec3 momentum = Vec3::Zero();
  Vec3 angular = Vec3::Zero();  // about the world's origin
  double energy_J = 0.0;
};

Sums sumsOf(const std::vector<Body>& bodies) {
  Sums sums;
  for (const Body& body : bodies) {
    const Vec3 p = body.inertia.mass_kg * body.velocity.linear;
    sums.momentum += p;
    sums.angular += body.X_WB.position.cross(p) +
                    angularMomentum(body.inertia, body.X_WB.rotation, body.velocity.angular);
    sums.energy_J += kineticEnergy(body.inertia, body.X_WB.rotation, body.velocity);
  }
  return sums;
}

Body bodyAt(double mass_kg, const Vec3& place, const Velocity& velocity) {
  Body body;
  body.inertia = inertiaOf(mass_kg, 1.0, Solid::box({0.3, 0.5, 0.7}).unitInertia());
  body.X_WB = {Quat(Eigen::AngleAxisd(mass_kg, Vec3(1.0, 2.0, 3.0).normalized())), place};
  body.velocity = velocity;
  return body;
}

// Three that fly past each other, 100 m from the world's origin.
std::vector<Body> threeBodies() {
  const Vec3 away(100.0, -40.0, 7.0), flight(0.0, 3.0, 1.0);
  return {bodyAt(1.0, away, {flight + Vec3(0.2, 0.5, 0.0), {0.3, 0.0, 1.0}}),
          bodyAt(3.0, away + Vec3(1.0, 0.0, 0.0), {flight + Vec3(-0.1, 1.0, 0.2), {0.0, -1.0, 0.2}}),
          bodyAt(2.0, away + Vec3(0.0, 0.9, 0.1), {flight + Vec3(0.3, 0.0, 0.4), {0.5, 0.5, -2.0}})};
}

// They meet while paths move them by this much, times the mass of all by that of each.
void meet(std::vector<Body>& bodies, const std::vector<std::pair<int, int>>& pairs,
          const std::vector<Vec3>& led) {
  FlightPlanner planner{WorldSettings{}};
  for (std::size_t i = 0; i < bodies.size(); ++i) planner.add({}, std::nullopt);
  ClosedIslands closed;
  closed.begin(bodies.size());
  for (const auto& [a, b] : pairs) closed.meet(a, b, bodies);
  closed.measure(bodies, planner);
  for (std::size_t i = 0; i < led.size(); ++i) bodies[i].X_WB.position += led[i] / bodies[i].inertia.mass_kg;
  closed.restore(bodies, planner);
}

TEST(ClosedIslands, LedBodiesKeepTheirMomenta_AndGainNoEnergy) {
  for (int seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::uniform_real_distribution<double> share(-1e-3, 1e-3);
    const auto way = [&] { return Vec3(share(random), share(random), share(random)); };
    std::vector<Body> bodies = threeBodies();
    const Vec3 first = way(), second = way();
    const Sums before = sumsOf(bodies);
    meet(bodies, {{0, 1}, {1, 2}}, {first, second, -first - second});
    const Sums after = sumsOf(bodies);
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13 * before.momentum.norm()) << seed;
    EXPECT_LE((after.angular - before.angular).norm(), 1e-13 * before.angular.norm()) << seed;
    EXPECT_LE(after.energy_J, (1.0 + 1e-14) * before.energy_J) << seed;
    EXPECT_GE(after.energy_J, (1.0 - 2e-3) * before.energy_J) << seed;
  }
}

TEST(ClosedIslands, SpeedsOfContactsStay_WhereTheRotationTakesNoEnergy) {
  std::vector<Body> bodies = threeBodies();
  bodies.resize(2);
  // Moved apart beside each other, they turn more slowly.
  bodies[0].velocity = {{0.0, -3.0, 0.0}, Vec3::Zero()};
  bodies[1].velocity = {{0.0, 1.0, 0.0}, Vec3::Zero()};
  const double before = sumsOf(bodies).energy_J;
  meet(bodies, {{0, 1}}, {{-2e-3, 0.0, 0.0}, {2e-3, 0.0, 0.0}});
  const Vec3 between = bodies[1].X_WB.position - bodies[0].X_WB.position;
  EXPECT_LT(sumsOf(bodies).energy_J, before);
  EXPECT_EQ(bodies[0].velocity.angular, bodies[1].velocity.angular);
  EXPECT_NEAR(dot(bodies[1].velocity.linear - bodies[0].velocity.linear, between), 0.0, 1e-15);
}

TEST(ClosedIslands, WhoMeetsWhatStandsIsLeftAsItIs) {
  std::vector<Body> bodies = threeBodies();
  bodies[2].is_static = true;
  std::vector<Body> led = bodies;
  meet(led, {{0, 1}, {1, 2}}, {{1e-3, 0.0, 0.0}, {-1e-3, 0.0, 0.0}});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(led[i].velocity.linear, bodies[i].velocity.linear);
    EXPECT_EQ(led[i].velocity.angular, bodies[i].velocity.angular);
  }
}

TEST(ClosedIslands, WhatTurnsAsOneHasNoEnergyToBeLedTogetherBy) {
  std::vector<Body> bodies = threeBodies();
  const Vec3 spin(0.0, 0.0, 2.0);
  for (Body& body : bodies) body.velocity = {spin.cross(body.X_WB.position), spin};
  std::vector<Body> led = bodies;
  const Vec3 inward = 1e-3 * (bodies[1].X_WB.position - bodies[0].X_WB.position);
  meet(led, {{0, 1}}, {inward, -inward});
  EXPECT_LE(sumsOf(led).energy_J, (1.0 + 1e-14) * sumsOf(bodies).energy_J);
}

double massOf(const std::vector<Body>& bodies) {
  double mass = 0.0;
  for (const Body& body : bodies) mass += body.inertia.mass_kg;
  return mass;
}

Vec3 centerOf(const std::vector<Body>& bodies) {
  Vec3 center = Vec3::Zero();
  for (const Body& body : bodies) center += body.inertia.mass_kg / massOf(bodies) * body.X_WB.position;
  return center;
}

// About the common centre of mass.
Vec3 turningOf(const std::vector<Body>& bodies) {
  const Sums sums = sumsOf(bodies);
  return sums.angular - centerOf(bodies).cross(sums.momentum);
}

// All go straight through the step, though not as their velocities say; loads push them along lines beside
// each other, not all of them balanced.
TEST(ClosedIslands, LoadsGiveTheirMomentOnThePathsThatBodiesTook) {
  WorldSettings settings;
  settings.step_s = 0.01;
  const std::vector<AppliedLoad> loads{{.force_W = {40.0, 0.0, 5.0}, .torque_W = {0.0, 0.0, 3.0}},
                                       {.force_W = {-30.0, 0.0, -5.0}},
                                       {.torque_W = {0.0, 0.5, -3.0}}};
  const std::vector<Vec3> ways{{0.002, 0.03, 0.01}, {-0.001, 0.05, 0.01}, {0.0, 0.02, 0.012}};
  FlightPlanner planner(settings);
  for (const AppliedLoad& load : loads) planner.add(load, std::nullopt);
  std::vector<Body> bodies = threeBodies();
  ClosedIslands closed;
  closed.begin(bodies.size());
  closed.meet(0, 1, bodies);
  closed.meet(1, 2, bodies);
  closed.measure(bodies, planner);
  const Vec3 before = turningOf(bodies), begin = centerOf(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].place_sum = 0.5 * settings.step_s * ways[i];
    bodies[i].load_work_J = 1.0;  // enough for what they turn faster by
    bodies[i].X_WB.position += ways[i];
    bodies[i].velocity.linear += settings.step_s / bodies[i].inertia.mass_kg * loads[i].force_W;
  }
  const Vec3 momentum = sumsOf(bodies).momentum, middle = 0.5 * (begin + centerOf(bodies));
  Vec3 given = Vec3::Zero();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec3 r = bodies[i].X_WB.position - 0.5 * ways[i] - middle;
    given += settings.step_s * (r.cross(loads[i].force_W) + loads[i].torque_W);
  }
  closed.restore(bodies, planner);
  EXPECT_LE((sumsOf(bodies).momentum - momentum).norm(), 1e-13 * momentum.norm());
  EXPECT_LE((turningOf(bodies) - before - given).norm(), 1e-11 * before.norm());
}

// What nothing gave them is taken from what they move beside their rotation, to the joule, and nothing that
// they have lost is given back.
TEST(ClosedIslands, HaveTheEnergyThatTheyBeganWithAtMost) {
  for (const double kick_mps : {0.3, -0.2}) {
    FlightPlanner planner{WorldSettings{}};
    std::vector<Body> bodies = threeBodies();
    bodies.resize(2);
    for (std::size_t i = 0; i < bodies.size(); ++i) planner.add({}, std::nullopt);
    ClosedIslands closed;
    closed.begin(bodies.size());
    closed.meet(0, 1, bodies);
    closed.measure(bodies, planner);
    const Sums before = sumsOf(bodies);
    // Along the line between the two, at which they part with 0.3 m/s.
    bodies[0].velocity.linear.x() -= 3.0 * kick_mps;
    bodies[1].velocity.linear.x() += kick_mps;
    const double kicked_J = sumsOf(bodies).energy_J;
    closed.restore(bodies, planner);
    const Sums after = sumsOf(bodies);
    EXPECT_NEAR(after.energy_J, std::min(before.energy_J, kicked_J), 1e-13 * before.energy_J) << kick_mps;
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-14 * before.momentum.norm());
    EXPECT_LE((after.angular - before.angular).norm(), 1e-14 * before.angular.norm());
  }
}

}  // namespace
}  // namespace carom
