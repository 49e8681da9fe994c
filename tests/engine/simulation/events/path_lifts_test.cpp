// What led paths lift by, and who pays for it: works and energies before and after.

#include "engine/simulation/events/path_lifts.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/simulation/contacts/carried_path.h"

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

// In which they touch nothing.
PairTable tableOf(const std::vector<Body>& bodies) {
  static const Solid cube = Solid::box({1.0, 1.0, 1.0});
  std::vector<Shape> shapes;
  std::vector<int> all;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    all.push_back(static_cast<int>(i));
    shapes.push_back({all.back(), &cube.parts()[0], 1.0, 1.0});
  }
  PairTable table;
  Crew alone;
  table.updateBounds(bodies, shapes, all, 0.0, alone);
  return table;
}

void pay(std::vector<Body>& bodies, const std::vector<std::pair<int, int>>& led,
         const AppliedLoad& load = {}) {
  PathLifts lifts;
  lifts.begin(bodies.size());
  for (const auto& [a, b] : led) lifts.join(a, b, bodies);
  std::vector<int> all;
  for (std::size_t i = 0; i < bodies.size(); ++i) all.push_back(static_cast<int>(i));
  ClosedIslands closed;
  closed.begin(bodies.size());
  lifts.pay(bodies, all, tableOf(bodies), plannerOf(std::vector<AppliedLoad>(bodies.size(), load)), closed);
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

TEST(PathLifts, WhatFallingCannotPayTippingDoes) {
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, -1.0}, {4.0, 5.0, 3.0}), bodyAt(1.0, Vec3::Zero())};
  bodies[0].inertia = inertiaOf(2.0, 1.0, Solid::box({1.0, 0.4, 2.0}).unitInertia());
  bodies[0].X_WB.rotation = Quat(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()));
  bodies[0].lift = bodies[1].lift = 1.5;
  const auto aboutGravity = [&] {
    return angularMomentum(bodies[0].inertia, bodies[0].X_WB.rotation, bodies[0].velocity.angular).z();
  };
  const double before = energyOf(bodies[0]), momentum = aboutGravity();
  pay(bodies, {});
  EXPECT_NEAR(energyOf(bodies[0]), before - 2.0 * 1.5, 1e-12);
  EXPECT_EQ(bodies[0].velocity.linear, Vec3(3.0, 0.0, 0.0));
  EXPECT_NEAR(aboutGravity(), momentum, 1e-14);
  EXPECT_EQ(bodies[1].velocity.linear, Vec3(Vec3::Zero())) << "what lies has nothing to pay with";
}

// A cube that goes across and turns about gravity: no force along that could have changed either.
TEST(PathLifts, WhatNeitherFallsNorTipsPaysNothing) {
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, 0.0}, {0.0, 0.0, 2.0})};
  bodies[0].lift = 1.5;
  pay(bodies, {});
  EXPECT_EQ(bodies[0].velocity.linear, Vec3(3.0, 0.0, 0.0));
  EXPECT_EQ(bodies[0].velocity.angular, Vec3(0.0, 0.0, 2.0));
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

// Loads that push them together move nothing as a whole; what they made of it lies in what each moves beside
// the others. What loads that turn with their bodies have done is not counted otherwise (closed_islands.h).
TEST(PathLifts, WhatOnlyMeetsItselfPaysToTheJouleAndKeepsItsMomentum) {
  std::vector<Body> bodies{bodyAt(1.0, {1.0, 2.0, -3.0}, {0.0, 0.4, 0.0}), bodyAt(4.0, {0.5, 2.0, 0.0})};
  bodies[1].X_WB.position = {1.1, 0.2, 0.0};
  bodies[0].lift = 0.3;
  bodies[1].lift = 0.05;
  const auto momentum = [&] { return Vec3(bodies[0].velocity.linear + 4.0 * bodies[1].velocity.linear); };
  const Vec3 before = momentum();
  const double energy = energyOf(bodies[0]) + energyOf(bodies[1]);
  const FlightPlanner planner = plannerOf({{.force_B = {50.0, 0.0, 0.0}}, {.force_B = {-50.0, 0.0, 0.0}}});
  ClosedIslands closed;
  PathLifts lifts;
  closed.begin(2);
  lifts.begin(2);
  closed.meet(0, 1, bodies);
  lifts.join(0, 1, bodies);
  closed.measure(bodies, planner);
  lifts.pay(bodies, std::vector<int>{0, 1}, tableOf(bodies), planner, closed);
  closed.restore(bodies, planner);
  EXPECT_LT((momentum() - before).norm(), 1e-14 * before.norm());
  EXPECT_NEAR(energyOf(bodies[0]) + energyOf(bodies[1]), energy - 0.3 - 4.0 * 0.05, 1e-12);
}

TEST(PathLifts, WhereNothingPullsNobodyPays) {
  WorldSettings settings;
  settings.gravity = Vec3::Zero();
  FlightPlanner planner(settings);
  planner.add({}, std::nullopt);
  std::vector<Body> bodies{bodyAt(2.0, {3.0, 0.0, -2.0})};
  bodies[0].lift = 1.5;
  PathLifts lifts;
  lifts.begin(1);
  ClosedIslands closed;
  closed.begin(1);
  lifts.pay(bodies, std::vector<int>{0}, tableOf(bodies), planner, closed);
  EXPECT_EQ(bodies[0].velocity.linear, Vec3(3.0, 0.0, -2.0));
}

// On its path from 0.1 s at 2 m/s along x, with this acceleration of its momentum, which falls.
Body ledBody(const Vec3& acceleration) {
  Body body = bodyAt(2.0, Vec3::Zero());
  body.travel = Travel::kCarried;
  body.path.start_s = 0.1;
  body.momentum_velocity.linear = {2.0, 0.0, -1.0};
  body.acceleration = acceleration;
  return body;
}

// The momentum would have fallen by 0.2 s * (1 + 3) m/s / 2; the path stays level.
TEST(PathLifts, ALevelPathLiftsByTheFallOfTheMomentum) {
  const Body body = ledBody({0.0, 0.0, -10.0});
  EXPECT_NEAR(liftOfPath(body, {{2.0, 0.0, -3.0}, Vec3::Zero()}, {0.4, 0.0, 0.0}, 0.3), 10.0 * 0.4, 1e-12);
  EXPECT_NEAR(liftOfPath(body, {{2.0, 0.0, -3.0}, Vec3::Zero()}, {0.4, 0.0, -0.4}, 0.3), 0.0, 1e-12);
}

TEST(PathLifts, WhatContactsBearIsNotLifted) {
  const Body body = ledBody(Vec3::Zero());
  EXPECT_EQ(liftOfPath(body, {{2.0, 0.0, -1.0}, Vec3::Zero()}, {0.4, 0.0, 0.3}, 0.3), 0.0);
}

TEST(PathLifts, WhatContactsDoOnThePathLifts) {
  Body body = ledBody(Vec3::Zero());
  body.opening_W = 20.0;
  EXPECT_NEAR(liftOfPath(body, {{2.0, 0.0, -1.0}, Vec3::Zero()}, {0.4, 0.0, -0.2}, 0.3), 20.0 * 0.2 / 2.0,
              1e-12);
}

// B stands on A with 10 N. Arms are along the normal.
OpeningPower openingWith(const Vec3& path_a, const Vec3& path_b, const Vec3& momentum_a,
                         const Vec3& momentum_b, double force_N = 10.0) {
  const Vec3 n = Vec3::UnitZ(), arm_a = 0.5 * n, arm_b = -0.5 * n;
  const PairMotions motions{
      {path_a, Vec3::Zero()}, {path_b, Vec3::Zero()}, {momentum_a, Vec3::Zero()}, {momentum_b, Vec3::Zero()}};
  return openingPower({n, arm_a, arm_b}, force_N, motions, 1e-9);
}

TEST(Openings, AreTheWorkOfWhatPressesOnTheOneThatIsLed) {
  const Vec3 up = Vec3::UnitZ(), still = Vec3::Zero();
  const OpeningPower raised = openingWith(still, 0.1 * up, still, still);
  EXPECT_EQ(raised.of_a_W, 0.0);
  EXPECT_NEAR(raised.of_b_W, 1.0, 1e-15);
  const OpeningPower both = openingWith(-0.1 * up, 0.3 * up, still, still);
  EXPECT_NEAR(both.of_a_W, 1.0, 1e-15);
  EXPECT_NEAR(both.of_b_W, 3.0, 1e-15);
}

TEST(Openings, AreNoneWhereNothingPressesOrOpensOrMomentaPart) {
  const Vec3 up = Vec3::UnitZ(), still = Vec3::Zero();
  EXPECT_EQ(openingWith(still, 0.1 * up, still, still, 0.0).of_b_W, 0.0);
  EXPECT_EQ(openingWith(0.1 * up, 0.1 * up, still, still).of_b_W, 0.0) << "raised together";
  EXPECT_EQ(openingWith(still, 1e-10 * up, still, still).of_b_W, 0.0) << "what a solver leaves";
  EXPECT_EQ(openingWith(still, 0.1 * up, still, 0.1 * up).of_b_W, 0.0) << "by itself";
  // What came down is held at its gap: that the momentum was stopped is no opening.
  EXPECT_EQ(openingWith(still, still, still, -0.1 * up).of_b_W, 0.0);
  EXPECT_NEAR(openingWith(still, 0.1 * up, still, -0.1 * up).of_b_W, 1.0, 1e-15);
}

TEST(PathLifts, APathThatTurnsLessThanTorquesHaveTurnedTheMomentumLiftsToo) {
  Body body = ledBody(Vec3::Zero());
  body.torque = {0.0, 5.0, 0.0};
  body.momentum_velocity.angular = {0.0, 1.0, 0.0};
  const double turn = 0.2 * 1.5;  // from 1 to 2 rad/s
  EXPECT_NEAR(liftOfPath(body, {{2.0, 0.0, -1.0}, {0.0, 2.0, 0.0}}, {0.4, 0.0, -0.2}, 0.3), 5.0 * turn / 2.0,
              1e-12);
}

TEST(PathLifts, InFlightThePathIsTheMomentums) {
  Body body = ledBody({0.0, 0.0, -10.0});
  body.travel = Travel::kBallistic;
  EXPECT_EQ(liftOfPath(body, {{2.0, 0.0, -3.0}, Vec3::Zero()}, {0.4, 0.0, 0.0}, 0.3), 0.0);
}

TEST(PathLifts, WhatIsDrivenPaysForNothing) {
  Body body = ledBody({0.0, 0.0, -10.0});
  body.travel = Travel::kDriven;
  body.is_kinematic = true;
  EXPECT_EQ(liftOfPath(body, {{2.0, 0.0, -3.0}, Vec3::Zero()}, {0.4, 0.0, 0.0}, 0.3), 0.0);
}

}  // namespace
}  // namespace carom
