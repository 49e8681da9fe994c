// Structures that stand, solved from a cold start in one go: their loads are those of statics, and what
// sweeps cannot carry that far the held rows, solved at once, do.

#include "engine/response/standing_solver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "engine/response/conjugate_sweeps.h"
#include "engine/response/held_rows.h"
#include "tests/engine/response/sweeps/masonry.h"

namespace carom {
namespace {

using oracle::Random;

SolverSettings settings() {
  return {.sweeps = 20, .residual_mps = 1e-6 * kGained};
}

// A step's solve goes on from the last one's: what a cold start leaves, the next steps solve.
SolverReport solveAsInSteps(Masonry& m) {
  SolverReport report;
  for (int step = 0; step < 4; ++step) report = solveStandingContacts(m.rows, m.bodies, settings());
  return report;
}

TEST(SolveStandingContacts, InAColumn_EveryBedCarriesWhatIsAbove) {
  for (const double heavy : {1.0, 1000.0})
    for (const int boxes : {10, 50, 200}) {
      Masonry m = columns(1, boxes, heavy);
      const SolverReport report = solveAsInSteps(m);
      EXPECT_LE(report.residual_mps, settings().residual_mps) << boxes << " " << heavy;
      EXPECT_LT(m.fastest(), 1e-4 * kGained) << boxes << " " << heavy;
      for (int bed = 0; bed < boxes; ++bed) {
        Vec3 carried = Vec3::Zero();
        for (std::size_t i = 0; i < 4; ++i)
          carried += rowImpulse(m.rows[4 * at(bed) + i], m.rows[4 * at(bed) + i].impulse);
        const double above = (boxes - bed - 1 + heavy) * kGained;
        EXPECT_LT((carried - Vec3(0, 0, above)).norm(), 1e-4 * above) << "bed " << bed << " of " << boxes;
      }
      expectWithinCones(m);
    }
}

// Boxes on rails: they go up and down, and turn not at all or about the rail.
TEST(SolveStandingContacts, InAColumnOnRails_EveryBedCarriesWhatIsAbove) {
  for (const bool turns : {false, true}) {
    Masonry m = columns(1, 100, 1.0);
    for (ImpulseBody& body : m.bodies) {
      if (body.inverse_mass == 0.0) continue;
      const double about_z = turns ? body.inverse_tensor(2, 2) : 0.0;
      body.free_axes = Vec3::UnitZ();
      body.inverse_tensor = Vec3(0.0, 0.0, about_z).asDiagonal();
      body.has_locks = true;
    }
    for (ContactRow& row : m.rows) prepareRow(row, m.bodies);
    solveAsInSteps(m);
    EXPECT_LT(m.fastest(), 1e-4 * kGained) << turns;
    for (int bed = 0; bed < 100; ++bed) {
      double carried = 0.0;
      for (std::size_t i = 0; i < 4; ++i) carried += m.rows[4 * at(bed) + i].impulse.x();
      EXPECT_NEAR(carried, (100 - bed) * kGained, 1e-4 * (100 - bed) * kGained) << turns << " bed " << bed;
    }
  }
}

TEST(SolveStandingContacts, AWallStandsWhereSweepsAloneLetItSink) {
  Masonry swept = wall(20, 12), solved = swept;
  solveContactsFinely(swept.rows, swept.bodies, {.sweeps = 300, .residual_mps = settings().residual_mps});
  EXPECT_GT(swept.fastest(), 1e-4 * kGained) << "the wall is too small for this test";
  solveAsInSteps(solved);
  EXPECT_LT(solved.fastest(), 1e-4 * kGained);
  Vec3 on_floor = Vec3::Zero();
  for (const ContactRow& row : solved.rows)
    if (row.a == 0) on_floor += rowImpulse(row, row.impulse);
  const double weight = static_cast<double>(solved.bodies.size() - 1) * kGained;
  EXPECT_LT((on_floor - Vec3(0, 0, weight)).norm(), 1e-5 * weight);
  expectWithinCones(solved);
}

TEST(SolveStandingContacts, StartedFromTheAnswerIsDoneAtOnce) {
  Masonry m = wall(10, 8);
  solveAsInSteps(m);
  for (std::size_t i = 1; i < m.bodies.size(); ++i)
    m.bodies[i].velocity = {Vec3(0, 0, -kGained), Vec3::Zero()};
  for (const ContactRow& row : m.rows) applyToRow(row, row.impulse, m.bodies);
  const SolverReport again = solveStandingContacts(m.rows, m.bodies, settings());
  EXPECT_LE(again.sweeps, 2);
}

// Where held rows contradict each other (a face whose corners want to part at speeds of no plane), or nothing
// stands at all.
TEST(SolveStandingContacts, NeverEndsWorseThanItsSweeps) {
  Random random(901);
  for (int i = 0; i < 300; ++i) {
    Meeting m = randomMeeting(random, 4, random.uniform(0.0, 1.0), random.logUniform(1e-3, 1e3));
    for (ContactRow& row : m.rows) row.lowest_speed = random.uniform(-0.1, 0.5);
    Meeting swept = m;
    const SolverSettings few{.sweeps = 4, .residual_mps = 1e-12};
    const double alone = solveContactsFinely(swept.rows, swept.bodies, few).residual_mps;
    EXPECT_LE(solveStandingContacts(m.rows, m.bodies, few).residual_mps, alone) << i;
    for (std::size_t r = 0; r < m.rows.size(); ++r) {
      const ContactRow& row = m.rows[r];
      EXPECT_LE(row.impulse.tail<2>().norm(), row.coefficient * row.impulse.x() * (1 + 1e-9) + 1e-15);
    }
    const Vec3 gained = linearMomentum(m.bodies[0]) + linearMomentum(m.bodies[1]);
    const Vec3 before = linearMomentum(swept.bodies[0]) + linearMomentum(swept.bodies[1]);
    EXPECT_LT((gained - before).norm(), 1e-9 * (1.0 + before.norm())) << i;
  }
}

// Bodies that touch others all over the place: the factor fills up.
TEST(SolveStandingContacts, WhatTakesTooManyProductsIsLeftToTheSweeps) {
  constexpr int kBodies = 300, kTouched = 3;
  Random random(902);
  Masonry m;
  for (int i = 0; i < kBodies; ++i) m.lay(random.direction(), 1.0);
  for (int i = 0; i < kTouched * kBodies; ++i) {
    const int a = 1 + i % kBodies;
    const int b = 1 + (i + 1 + static_cast<int>(random.uniform(0.0, kBodies - 1.0))) % kBodies;
    m.rows.push_back(rowAt({.a = a, .b = b, .n = random.direction(), .p_W = random.direction()}, m.bodies));
    m.rows.back().lowest_speed = random.uniform(0.0, 0.5);
  }
  Masonry swept = m;
  SolverSettings few{.sweeps = 4, .residual_mps = 1e-12};
  const SolverReport alone = solveContactsFinely(swept.rows, swept.bodies, few);
  few.most_products = 100 * static_cast<long>(m.rows.size());
  Masonry left = m;
  const SolverReport report = solveStandingContacts(left.rows, left.bodies, few);
  EXPECT_GT(report.residual_mps, few.residual_mps) << "the sweeps have solved it";
  EXPECT_GT(report.products, few.most_products) << "it is cheap";
  EXPECT_EQ(report.visits, alone.visits);
  for (std::size_t i = 0; i < m.rows.size(); ++i) EXPECT_EQ(left.rows[i].impulse, swept.rows[i].impulse) << i;
  few.most_products = report.products;
  EXPECT_GT(solveStandingContacts(m.rows, m.bodies, few).visits, alone.visits);
}

using Exact = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// The same equations, dense, from nothing but the velocities that unit velocities of the bodies give.
TEST(HeldRows, AStepSolvesTheEquationsOfAllRows) {
  Masonry m = wall(4, 3);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    m.rows[i].impulse = Vec3(0.1 + 0.01 * static_cast<double>(i % 7), 0.0, 0.0);
    applyToRow(m.rows[i], m.rows[i].impulse, m.bodies);
  }
  const int unknowns = 6 * (static_cast<int>(m.bodies.size()) - 1);
  const int equations = 3 * static_cast<int>(m.rows.size());
  Exact jacobian(equations, unknowns);
  Exact inverse_inertia = Exact::Zero(unknowns, unknowns);
  Exact softness = Exact::Zero(equations, equations);
  Exact miss(equations, 1);
  std::vector<ImpulseBody> probe = m.bodies;
  for (ImpulseBody& body : probe) body.velocity = {};
  for (int k = 0; k < unknowns; ++k) {
    ImpulseBody& body = probe[at(k / 6 + 1)];
    (k % 6 < 3 ? body.velocity.linear : body.velocity.angular)[k % 3] = 1.0;
    for (std::size_t i = 0; i < m.rows.size(); ++i)
      jacobian.block(3 * static_cast<int>(i), k, 3, 1) = rowVelocity(m.rows[i], probe).cast<long double>();
    body.velocity = {};
    inverse_inertia(k, k) = k % 6 < 3 ? body.inverse_mass : body.inverse_tensor(k % 3, k % 3);
  }
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const int k = 3 * static_cast<int>(i);
    miss.block(k, 0, 3, 1) = rowMiss(m.rows[i], m.bodies).cast<long double>();
    softness.block(k, k, 3, 3) =
        (rowResponse(m.rows[i], m.bodies) / HeldRows::kStiffness).cast<long double>();
  }
  // Impulses x with J (v + M^-1 J' x) - b = -softness x.
  const Exact response = jacobian * inverse_inertia * jacobian.transpose() + softness;
  const Exact impulses = response.fullPivLu().solve(-miss);
  const std::vector<ContactRow> before = m.rows;
  HeldRows held(m.rows, m.bodies);
  ASSERT_TRUE(held.step(m.rows, m.bodies));
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    const Vec3 expected = impulses.block(3 * static_cast<int>(i), 0, 3, 1).cast<double>();
    EXPECT_LT((m.rows[i].impulse - before[i].impulse - expected).norm(), 1e-6) << i;
  }
}

// A box that falls and turns, or only turns, as its locks allow: held at its corners (on a hinge without
// friction, which its axis would leave nothing to do) it has come to rest, but for one share of the
// stiffness.
TEST(HeldRows, AStepBringsToRestWhatTurnsOnARailOrAHinge) {
  for (const bool hinge : {false, true}) {
    Masonry m = columns(1, 1);
    ImpulseBody& body = m.bodies[1];
    body.has_locks = true;
    body.free_axes = hinge ? Vec3(Vec3::Zero()) : Vec3::UnitZ();
    if (hinge) body.inverse_tensor = Vec3(0.0, body.inverse_tensor(1, 1), 0.0).asDiagonal();
    body.velocity.linear = -kGained * body.free_axes;
    body.velocity.angular = hinge ? Vec3(0.0, 0.3, 0.0) : Vec3(0.2, 0.3, -0.1);
    for (ContactRow& row : m.rows) {
      if (hinge) row.friction = {};
      prepareRow(row, m.bodies);
      row.impulse = Vec3(0.05, 0.0, 0.0);
    }
    HeldRows held(m.rows, m.bodies);
    ASSERT_TRUE(held.step(m.rows, m.bodies));
    EXPECT_LT(m.fastest(), 1e-6) << (hinge ? "on a hinge" : "on a rail");
  }
}

TEST(HeldRows, LeavesAloneWhatDoesNotPressAndTheFrictionOfWhatSlides) {
  Masonry m = columns(1, 2);
  for (ContactRow& row : m.rows) row.impulse = Vec3(0.05, 0.0, 0.0);
  m.rows[0].impulse = Vec3::Zero();
  m.rows[5].impulse = Vec3(0.05, 0.5 * 0.05, 0.0);  // on its cone
  for (const ContactRow& row : m.rows) applyToRow(row, row.impulse, m.bodies);
  HeldRows held(m.rows, m.bodies);
  ASSERT_TRUE(held.step(m.rows, m.bodies));
  EXPECT_EQ(m.rows[0].impulse, Vec3(Vec3::Zero()));
  EXPECT_EQ(m.rows[5].impulse.y(), 0.5 * 0.05);
  EXPECT_NE(m.rows[5].impulse.x(), 0.05);
  EXPECT_NE(m.rows[1].impulse.x(), 0.05);
}

}  // namespace
}  // namespace carom
