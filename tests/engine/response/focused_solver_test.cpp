// Crowds: the same conditions as from sweeps over all rows, with the work where it is needed.

#include "engine/response/focused_solver.h"

#include <gtest/gtest.h>

#include "engine/response/conjugate_sweeps.h"
#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/turning_resistance.h"
#include "tests/engine/response/sweeps/masonry.h"

namespace carom {
namespace {

// The next step of what has stood for some steps: its loads and gravity.
Masonry standing(Masonry m) {
  for (int step = 0; step < 4; ++step)
    solveStandingContacts(m.rows, m.bodies, {.sweeps = 20, .residual_mps = 1e-8 * kGained});
  for (std::size_t i = 1; i < m.bodies.size(); ++i)
    m.bodies[i].velocity = {Vec3(0, 0, -kGained), Vec3::Zero()};
  for (const ContactRow& row : m.rows) applyToRow(row, row.impulse, m.bodies);
  return m;
}

TEST(SolveContactsFocused, OfFewRows_IsTheSameBitForBit) {
  Masonry finely = wall(10, 8), focused = finely;
  ASSERT_LT(finely.rows.size(), kFocusedRows);
  const SolverSettings settings{.sweeps = 30, .residual_mps = 1e-9};
  const SolverReport a = solveContactsFinely(finely.rows, finely.bodies, settings);
  const SolverReport b = solveContactsFocused(focused.rows, focused.bodies, settings);
  EXPECT_EQ(a.visits, b.visits);
  EXPECT_EQ(a.residual_mps, b.residual_mps);
  for (std::size_t i = 0; i < finely.rows.size(); ++i)
    EXPECT_EQ(finely.rows[i].impulse, focused.rows[i].impulse) << i;
}

TEST(SolveContactsFocused, WhereOneOfManyColumnsIsStruck_TakesAFractionOfTheVisits) {
  Masonry finely = standing(columns(60, 10));
  finely.bodies[5].velocity.linear += Vec3(0.02, 0.01, -0.03);
  Masonry focused = finely;
  const SolverSettings settings{.sweeps = 1000, .residual_mps = 1e-3 * kGained};
  const SolverReport all = solveContactsFinely(finely.rows, finely.bodies, settings);
  const SolverReport some = solveContactsFocused(focused.rows, focused.bodies, settings);
  EXPECT_LE(all.residual_mps, settings.residual_mps);
  EXPECT_LE(some.residual_mps, settings.residual_mps);
  EXPECT_GT(all.sweeps, 20) << "too little happens for this test";
  EXPECT_LT(3 * some.visits, 2 * all.visits);
  expectWithinCones(focused);
}

// One row that never converges does not keep a crowd sweeping that has in the mean.
TEST(SolveContactsFocused, InTheMean_StopsWhereAFewRowsAreLeft) {
  Masonry all = standing(columns(60, 10));
  all.bodies[5].velocity.linear += Vec3(0.02, 0.01, -0.03);
  Masonry mean = all;
  SolverSettings settings{.sweeps = 1000, .residual_mps = 1e-3 * kGained};
  const SolverReport until_all = solveContactsFocused(all.rows, all.bodies, settings);
  settings.in_the_mean = true;
  const SolverReport in_mean = solveContactsFocused(mean.rows, mean.bodies, settings);
  EXPECT_GT(in_mean.residual_mps, settings.residual_mps);
  EXPECT_LE(in_mean.excess, static_cast<long>(mean.rows.size()));
  EXPECT_GT(in_mean.excess, 0);
  EXPECT_LT(2 * in_mean.visits, until_all.visits);
  expectWithinCones(mean);
}

TEST(SolveContactsFocused, TheVelocitiesAreThoseThatTheImpulsesGive) {
  Masonry m = wall(16, 16);
  ASSERT_GE(m.rows.size(), kFocusedRows);
  std::vector<ImpulseBody> given = m.bodies;
  solveContactsFocused(m.rows, m.bodies, {.sweeps = 60, .residual_mps = 1e-12});
  for (const ContactRow& row : m.rows) applyToRow(row, row.impulse, given);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_LT((m.bodies[i].velocity.linear - given[i].velocity.linear).norm(), 1e-12) << i;
    EXPECT_LT((m.bodies[i].velocity.angular - given[i].velocity.angular).norm(), 1e-11) << i;
  }
  expectWithinCones(m);
}

// What resists turning has torques as well, which the struck box and its neighbours take.
TEST(SolveContactsFocused, TheVelocitiesAreThoseThatImpulsesAndTorquesGive) {
  Masonry m = standing(columns(60, 10));
  m.bodies[5].velocity.linear += Vec3(0.02, 0.01, -0.03);
  m.bodies[5].velocity.angular += Vec3(0.03, -0.02, 0.05);
  for (ContactRow& row : m.rows) {
    row.resistance = {0.02, 0.02};
    prepareRow(row, m.bodies);
  }
  const Masonry before = m;
  std::vector<ImpulseBody> given = m.bodies;
  solveContactsFocused(m.rows, m.bodies, {.sweeps = 1000, .residual_mps = 1e-3 * kGained});
  double torques = 0.0;
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    applyToRow(m.rows[i], m.rows[i].impulse - before.rows[i].impulse, given);
    applyTorqueToRow(m.rows[i], m.rows[i].torque, given);
    torques += m.rows[i].torque.norm();
  }
  EXPECT_GT(torques, 1e-4) << "nothing resists";
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_LT((m.bodies[i].velocity.linear - given[i].velocity.linear).norm(), 1e-12) << i;
    EXPECT_LT((m.bodies[i].velocity.angular - given[i].velocity.angular).norm(), 1e-11) << i;
  }
}

// From a cold start the work is everywhere, and conjugate gradients over all rows, not broken off, do it
// best.
TEST(SolveContactsFocused, FromAColdStart_ComesAsFarAsSweepsOverAllRows) {
  Masonry finely = wall(20, 15), focused = finely;
  const SolverSettings settings{.sweeps = 100, .residual_mps = 1e-9 * kGained};
  solveContactsFinely(finely.rows, finely.bodies, settings);
  const SolverReport report = solveContactsFocused(focused.rows, focused.bodies, settings);
  EXPECT_LE(report.sweeps, settings.sweeps + 4);
  EXPECT_LT(focused.fastest(), 1.5 * finely.fastest());
}

}  // namespace
}  // namespace carom
