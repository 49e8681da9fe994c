// Sweeps along conjugate directions: the same conditions as from plain sweeps, in fewer of them.

#include "engine/response/conjugate_sweeps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/response/sweeps/turning_resistance.h"
#include "tests/engine/response/sweeps/masonry.h"

namespace carom {
namespace {

TEST(InvolvedBodies, AreThoseOfTheRowsEachOnce) {
  Masonry m = wall(3, 4);
  m.lay(Vec3(50, 0, 0), 1.0);  // touches nothing
  std::vector<std::size_t> ascending = involvedBodies(m.rows, m.bodies);
  std::sort(ascending.begin(), ascending.end());
  ASSERT_EQ(ascending.size(), m.bodies.size() - 1);
  for (std::size_t i = 0; i < ascending.size(); ++i) EXPECT_EQ(ascending[i], i);
}

// Islands are listed one after another from the same bodies.
TEST(InvolvedBodies, LeaveNothingBehindForTheNextList) {
  Masonry m = columns(2, 3);
  const std::span<ContactRow> rows(m.rows);
  const std::size_t half = rows.size() / 2;
  EXPECT_EQ(involvedBodies(rows.first(half), m.bodies), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(involvedBodies(rows.last(half), m.bodies), (std::vector<std::size_t>{0, 4, 5, 6}));
}

TEST(ConjugateSweeps, ReachTheResidualInAFractionOfTheSweeps) {
  Masonry plainly = wall(6, 5), finely = plainly;
  SolverSettings settings{.sweeps = 500, .residual_mps = 1e-5 * kGained};
  const SolverReport fine = solveContactsFinely(finely.rows, finely.bodies, settings);
  EXPECT_LE(fine.residual_mps, settings.residual_mps);
  expectWithinCones(finely);
  settings.sweeps = 3 * fine.sweeps;
  EXPECT_GT(solveContacts(plainly.rows, plainly.bodies, settings).residual_mps, settings.residual_mps);
}

// Each call begins without a direction, whatever the last one left.
TEST(ConjugateSweeps, OneAfterAnotherAreThoseOfFreshOnesBitForBit) {
  Masonry kept = wall(6, 5), fresh = kept;
  const SolverSettings settings{.sweeps = 12, .residual_mps = 1e-12};
  ConjugateSweeps sweeps(kept.rows, kept.bodies);
  for (int round = 0; round < 3; ++round) {
    const SolverReport a = sweeps.solve(settings);
    const SolverReport b = solveContactsFinely(fresh.rows, fresh.bodies, settings);
    EXPECT_EQ(a.residual_mps, b.residual_mps) << round;
    for (std::size_t i = 0; i < kept.rows.size(); ++i)
      ASSERT_EQ(kept.rows[i].impulse, fresh.rows[i].impulse) << round << " " << i;
  }
}

// What resists turning has torques as well, which the struck box and its neighbours take.
TEST(ConjugateSweeps, TheVelocitiesAreThoseThatImpulsesAndTorquesGive) {
  Masonry m = columns(60, 10);
  m.bodies[5].velocity.linear += Vec3(0.02, 0.01, -0.03);
  m.bodies[5].velocity.angular += Vec3(0.03, -0.02, 0.05);
  for (ContactRow& row : m.rows) {
    row.resistance = {0.02, 0.02};
    prepareRow(row, m.bodies);
  }
  std::vector<ImpulseBody> given = m.bodies;
  solveContactsFinely(m.rows, m.bodies, {.sweeps = 60, .residual_mps = 1e-3 * kGained});
  double torques = 0.0;
  for (const ContactRow& row : m.rows) {
    applyToRow(row, row.impulse, given);
    applyTorqueToRow(row, row.torque, given);
    torques += row.torque.norm();
  }
  EXPECT_GT(torques, 1e-4) << "nothing resists";
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_LT((m.bodies[i].velocity.linear - given[i].velocity.linear).norm(), 1e-12) << i;
    EXPECT_LT((m.bodies[i].velocity.angular - given[i].velocity.angular).norm(), 1e-11) << i;
  }
  expectWithinCones(m);
}

}  // namespace
}  // namespace carom
