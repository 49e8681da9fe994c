// Simultaneous impulses: at convergence the contact conditions hold, friction opposes the motion whichever
// way it heads, and the answer does not depend on the way there.

#include "engine/response/sweeps/contact_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

constexpr SolverSettings kThorough{100000, 1e-14, true};

TEST(PrepareRow, MakesARightHandedFrameAndItsResponse) {
  Random random(101);
  for (int i = 0; i < 100; ++i) {
    Meeting m = randomMeeting(random, 1, 0.3, 2.0);
    const ContactRow& row = m.rows[0];
    EXPECT_LT((row.n.cross(row.t1) - row.t2).norm(), 1e-14);
    const Vec3 before = rowVelocity(row, m.bodies), impulse = random.direction();
    applyToRow(row, impulse, m.bodies);
    const Vec3 change = rowVelocity(row, m.bodies) - before;
    EXPECT_LT((row.inverse_response * change - impulse).norm(), 1e-9 * impulse.norm());
    EXPECT_NEAR(change.x(), row.normal_response.dot(impulse), 1e-12);
  }
}

// Whether an impulse within the cone can make a point approach: the worst one is on its edge. Long rods on
// rough ground have such (Painleve 1895).
TEST(PrepareRow, PartsIdlyWhereNoImpulseWithinItsConeMakesItApproach) {
  Random random(102);
  int idle = 0;
  constexpr int kRows = 1000;
  for (int i = 0; i < kRows; ++i) {
    const Meeting m = randomMeeting(random, 1, random.uniform(0.0, 8.0), random.logUniform(1e-2, 1e2));
    ContactRow row = m.rows[0];
    setCoefficient(row, random.uniform(0.5, 1.0) * row.coefficient);
    double slowest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 360; ++k) {
      const double angle = k * std::numbers::pi / 180.0;
      const Vec3 impulse(1.0, row.coefficient * std::cos(angle), row.coefficient * std::sin(angle));
      slowest = std::min(slowest, row.normal_response.dot(impulse) / row.normal_response.x());
    }
    if (std::abs(slowest) < 1e-3) continue;  // between two degrees
    EXPECT_EQ(row.parts_idly, slowest > 0.0) << i << " " << slowest;
    idle += row.parts_idly;
  }
  EXPECT_GT(idle, kRows / 4);
  EXPECT_LT(idle, kRows * 3 / 4);
}

// Normal: u >= lowest, j >= 0, complementary. Friction: within the cone; where it slips, full and against the
// slip.
void expectContactConditions(const Meeting& m, double accuracy) {
  for (const ContactRow& row : m.rows) {
    const Vec3 u = rowVelocity(row, m.bodies);
    const double speed = 1.0, j = row.impulse.x();
    EXPECT_GE(u.x(), row.lowest_speed - accuracy * speed);
    EXPECT_GE(j, 0.0);
    EXPECT_LT(std::min(j * row.normal_response.x(), u.x() - row.lowest_speed), accuracy * speed)
        << "presses or parts, not both";
    const Vec2 friction = row.impulse.tail<2>(), slip = u.tail<2>();
    EXPECT_LE(friction.norm(), row.friction.static_coefficient * j * (1 + 1e-9) + 1e-15);
    if (slip.norm() < 1e-6 * speed || j * row.normal_response.x() < 1e-6) continue;
    const double limit = row.friction.dynamic_coefficient * j;
    EXPECT_LT((friction + limit * slip.normalized()).norm(), 1e-5 * limit) << "slip " << slip.transpose();
  }
}

TEST(SolveContacts, AtOnePoint_MeetsTheContactConditions) {
  const std::uint64_t seed = 102;
  Random random(seed);
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    Meeting m = randomMeeting(random, 1, random.uniform(0, 1.0), random.logUniform(1e-2, 1e2));
    const SolverReport report = solveContacts(m.rows, m.bodies, kThorough);
    ASSERT_LT(report.sweeps, kThorough.sweeps);
    expectContactConditions(m, 1e-9);
    if (HasFailure()) return;
  }
}

TEST(SolveContacts, AtFourPoints_MeetsTheContactConditions) {
  const std::uint64_t seed = 103;
  Random random(seed);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    Meeting m = randomMeeting(random, 4, random.uniform(0, 0.8), random.logUniform(0.1, 10));
    for (ContactRow& row : m.rows) row.lowest_speed = random.uniform(-0.3, 0.1);
    solveContacts(m.rows, m.bodies, kThorough);
    expectContactConditions(m, 1e-6);
    if (HasFailure()) return;
  }
}

// A block that slides, in any direction: equal friction, straight against the motion.
TEST(SolveContacts, BrakesAlikeInEveryDirection) {
  const double mu = 0.4, j_normal = 0.7;  // of 1 kg, and a normal approach of 0.7 m/s
  const Inertia inertia = boxInertia(1.0, {0.7, 0.3, 0.2});
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3 heading(std::cos(angle), std::sin(angle), 0);
    Meeting m;
    m.bodies = {immovable(), impulseBody(inertia, oracle::turned(Vec3::UnitZ(), 0.3), Vec3(0, 0, 0.1),
                                         {5.0 * heading - Vec3(0, 0, j_normal), Vec3::Zero()})};
    for (double x : {-0.35, 0.35})
      for (double y : {-0.15, 0.15})
        m.rows.push_back(rowAt(
            {.p_W = oracle::turned(Vec3::UnitZ(), 0.3) * Vec3(x, y, 0), .friction = {mu, mu}}, m.bodies));
    solveContacts(m.rows, m.bodies, kThorough);
    EXPECT_LT((m.bodies[1].velocity.linear - (5.0 - mu * j_normal) * heading).norm(), 1e-9) << degrees;
    EXPECT_LT(m.bodies[1].velocity.angular.norm(), 1e-8) << degrees;
  }
}

TEST(SolveContacts, HoldsABlockThatTheConeCanHold) {
  const Inertia inertia = boxInertia(1.0, {0.7, 0.3, 0.2});
  for (const double tangent : {0.1, 0.399}) {
    Meeting m;
    m.bodies = {immovable(), impulseBody(inertia, Quat::Identity(), Vec3(0, 0, 0.1),
                                         {Vec3(0.8 * tangent, 0.6 * tangent, -1.0), Vec3::Zero()})};
    for (double x : {-0.35, 0.35})
      for (double y : {-0.15, 0.15})
        m.rows.push_back(rowAt({.p_W = Vec3(x, y, 0), .friction = {0.4, 0.4}}, m.bodies));
    solveContacts(m.rows, m.bodies, kThorough);
    EXPECT_LT(m.bodies[1].velocity.linear.norm() + m.bodies[1].velocity.angular.norm(), 1e-9) << tangent;
  }
}

// A tall block near its tipping point on rough ground: normal and friction impulses work against each other
// at every corner, and taking them in turn must not go round in circles. Statics: it stands while tan < b / h
// and tan <= mu.
TEST(SolveContacts, HoldsATallBlockHoweverRoughTheGround) {
  const Vec3 size(0.3, 0.4, 0.9);
  for (const double mu : {0.4, 1.0, 2.0, 4.0})
    for (const double tangent : {0.7 / 3, 0.95 / 3, 0.99 / 3}) {
      const Quat tilt = oracle::turned(Vec3::UnitY(), std::atan(tangent));
      const Vec3 center = tilt * Vec3(0, 0, 0.45);
      Meeting m;
      m.bodies = {immovable(),
                  impulseBody(boxInertia(2.0, size), tilt, center, {Vec3(0, 0, -1), Vec3::Zero()})};
      for (double x : {-0.15, 0.15})
        for (double y : {-0.2, 0.2})
          m.rows.push_back(rowAt(
              {.n = tilt * Vec3::UnitZ(), .p_W = tilt * Vec3(x, y, 0), .friction = {mu, mu}}, m.bodies));
      solveContacts(m.rows, m.bodies, {5000, 1e-13, true});
      EXPECT_LT(m.bodies[1].velocity.linear.norm() + m.bodies[1].velocity.angular.norm(), 1e-6)
          << "mu " << mu << " tan " << tangent;
    }
}

// With one point: what the static cone holds is held; beyond it the dynamic coefficient brakes.
// A point that lay still when its row was prepared is held by the static coefficient, one that slid by the
// dynamic one.
TEST(SolveContacts, TellsStaticFrictionFromDynamic) {
  const double mu_s = 0.6, mu_d = 0.3;
  for (const bool slid : {false, true})
    for (const double tangent : {0.29, 0.31, 0.59, 0.61}) {
      const Velocity pushed{Vec3(tangent, 0, -1.0), Vec3::Zero()};
      Meeting m;
      m.bodies = {immovable(), impulseBody(boxInertia(1.0, {1, 1, 1}), Quat::Identity(), Vec3::Zero(),
                                           slid ? pushed : Velocity{})};
      m.rows = {rowAt({.friction = {mu_s, mu_d}}, m.bodies)};  // the point is the centre: no lever
      m.bodies[1].velocity = pushed;
      solveContacts(m.rows, m.bodies, kThorough);
      EXPECT_NEAR(m.bodies[1].velocity.linear.x(), std::max(0.0, tangent - (slid ? mu_d : mu_s)), 1e-12)
          << tangent << slid;
    }
}

TEST(SolveContacts, ConvergesToTheSameVelocitiesInAnyOrder) {
  Random random(104);
  for (int i = 0; i < 100; ++i) {
    Meeting forward = randomMeeting(random, 4, 0.0, 2.0);
    Meeting backward = forward;
    std::reverse(backward.rows.begin(), backward.rows.end());
    solveContacts(forward.rows, forward.bodies, kThorough);
    solveContacts(backward.rows, backward.bodies, kThorough);
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_LT((forward.bodies[b].velocity.linear - backward.bodies[b].velocity.linear).norm(), 1e-9) << i;
      EXPECT_LT((forward.bodies[b].velocity.angular - backward.bodies[b].velocity.angular).norm(), 1e-8) << i;
    }
  }
}

TEST(SolveContacts, StartedFromTheAnswerIsDoneAtOnce) {
  Random random(105);
  for (int i = 0; i < 100; ++i) {
    Meeting m = randomMeeting(random, 4, 0.4, 2.0);
    solveContacts(m.rows, m.bodies, kThorough);
    const SolverReport again = solveContacts(m.rows, m.bodies, {100, 1e-10, true});
    EXPECT_EQ(again.sweeps, 1) << i;
  }
}

TEST(SolveContacts, KeepsLinearAndAngularMomentum) {
  Random random(106);
  for (int i = 0; i < 200; ++i) {
    Meeting m = randomMeeting(random, random.integer(1, 4), 0.6, random.logUniform(0.1, 10));
    const Vec3 p = linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]);
    const Vec3 L = angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]);
    const double scale = linearMomentum(m.bodies[0]).norm() + linearMomentum(m.bodies[1]).norm();
    solveContacts(m.rows, m.bodies, {100, 0.0, true});
    EXPECT_LT((linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]) - p).norm(), 1e-12 * scale) << i;
    EXPECT_LT((angularMomentum(m.bodies[0]) + angularMomentum(m.bodies[1]) - L).norm(), 1e-12 * scale) << i;
  }
}

}  // namespace
}  // namespace carom
