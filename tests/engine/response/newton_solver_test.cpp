// Few rows at once: the conditions of contact themselves are the oracle, and sweeps that go on for very long.

#include "engine/response/newton_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/response/sweeps/random_contact.h"

namespace carom {
namespace {

using oracle::Random;

// Signorini's and Coulomb's conditions, without the projection that the solver is made of.
void expectContact(const Meeting& m, double tolerated_mps, const std::string& what) {
  for (const ContactRow& row : m.rows) {
    const Vec3 miss = rowMiss(row, m.bodies);
    const double pressing = row.impulse.x();
    const double response = row.normal_response.x();
    ASSERT_GE(miss.x(), -tolerated_mps) << what << ": approaches";
    ASSERT_GE(pressing, 0.0) << what << ": pulls";
    ASSERT_LE(std::min(pressing * response, miss.x()), tolerated_mps) << what << ": presses and parts";
    const Vec2 friction = row.impulse.tail<2>();
    const double limit = row.coefficient * pressing;
    ASSERT_LE(friction.norm(), limit * (1 + 1e-9) + 1e-15) << what << ": leaves its cone";
    const double spared = (limit - friction.norm()) * response;
    const double slip = miss.tail<2>().norm();
    ASSERT_LE(std::min(spared, slip), tolerated_mps) << what << ": slides below its limit";
    if (slip > 1e3 * tolerated_mps && limit * response > 1e3 * tolerated_mps) {
      ASSERT_LT((friction / limit + miss.tail<2>() / slip).norm(), 1e-2)
          << what << ": friction does not oppose";
    }
  }
}

std::string told(std::uint64_t seed, int i) {
  return "seed " + std::to_string(seed) + " case " + std::to_string(i);
}

TEST(SolveContactsByNewton, HoldsTheConditionsOfContact) {
  const std::uint64_t seed = 301;
  Random random(seed);
  int converged = 0;
  const int cases = 3000;
  for (int i = 0; i < cases; ++i) {
    Meeting m =
        randomMeeting(random, random.integer(1, 4), random.uniform(0, 1), random.logUniform(1e-3, 1e3));
    const SolverReport report = solveContactsByNewton(m.rows, m.bodies, {60, 1e-12, true});
    if (report.residual_mps > 1e-12) continue;
    ++converged;
    expectContact(m, 1e-9, told(seed, i));
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(converged, cases * 98 / 100);
}

// Two points of one face, as near to each other as clipped polygons leave them: sweeps hand the load from one
// to the other by steps as small as their distance.
TEST(SolveContactsByNewton, ConvergesWhereSweepsCreep) {
  const std::uint64_t seed = 302;
  Random random(seed);
  const int cases = 500;
  int creeps = 0, converged = 0;
  for (int i = 0; i < cases; ++i) {
    Meeting m = randomMeeting(random, 2, random.uniform(0.1, 0.7), 1.0);
    const Vec3 p_W = m.rows[0].r_a + m.bodies[0].center + 3e-4 * m.rows[0].t1;
    m.rows[1] = rowAt({.n = m.rows[0].n, .p_W = p_W, .friction = m.rows[0].friction}, m.bodies);
    Meeting swept = m;
    creeps += solveContacts(swept.rows, swept.bodies, {400, 1e-12, true}).residual_mps > 1e-12;
    const SolverReport report = solveContactsByNewton(m.rows, m.bodies, {60, 1e-12, true});
    if (report.residual_mps > 1e-12) continue;
    ++converged;
    expectContact(m, 1e-9, told(seed, i));
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(creeps, cases / 4) << "the case is no longer hard";
  EXPECT_GE(converged, cases * 95 / 100);
}

TEST(SolveContactsByNewton, WithoutFriction_FindsTheVelocitiesThatSweepsFind) {
  const std::uint64_t seed = 303;
  Random random(seed);
  for (int i = 0; i < 500; ++i) {
    Meeting m = randomMeeting(random, 3, 0.5, random.logUniform(1e-2, 1e2));
    Meeting swept = m;
    ASSERT_LE(solveContactsByNewton(m.rows, m.bodies, {60, 1e-13, false}).residual_mps, 1e-13)
        << told(seed, i);
    if (solveContacts(swept.rows, swept.bodies, {100000, 1e-15, false}).residual_mps > 1e-14) continue;
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
      ASSERT_LT((m.bodies[b].velocity.linear - swept.bodies[b].velocity.linear).norm(), 1e-9)
          << told(seed, i);
      ASSERT_LT((m.bodies[b].velocity.angular - swept.bodies[b].velocity.angular).norm(), 1e-9)
          << told(seed, i);
    }
    for (const ContactRow& row : m.rows) ASSERT_TRUE(row.impulse.tail<2>().isZero(0.0)) << told(seed, i);
  }
}

// Balls on each other on the floor, each a hundred times as heavy as the one below.
TEST(SolveContactsByNewton, CarriesAColumnOfVeryUnequalMasses) {
  std::vector<ImpulseBody> bodies{immovable()};
  std::vector<ContactRow> rows;
  double density = 1.0;
  for (int i = 0; i < 4; ++i, density *= 100.0) {
    const Solid ball = Solid::ball(0.5);
    const Inertia inertia = inertiaOf(density, ball.volume(), ball.unitInertia());
    bodies.push_back(
        impulseBody(inertia, Quat::Identity(), Vec3(0, 0, i + 0.5), {Vec3(0, 0, -1), Vec3::Zero()}));
    rows.push_back(rowAt({.a = i, .b = i + 1, .p_W = Vec3(0, 0, i), .friction = {0.5, 0.5}}, bodies));
  }
  solveContactsByNewton(rows, bodies, {60, 1e-12, true});
  for (const ImpulseBody& body : bodies) EXPECT_LT(body.velocity.linear.norm(), 1e-9);
}

TEST(SolveContactsByNewton, LeavesWhatPartsAlone) {
  Random random(304);
  Meeting m = randomMeeting(random, 2, 0.5, 1.0);
  for (ImpulseBody& body : m.bodies) body.velocity = {};
  m.bodies[1].velocity.linear = m.rows[0].n;
  for (ContactRow& row : m.rows) prepareRow(row, m.bodies);
  solveContactsByNewton(m.rows, m.bodies, {60, 1e-12, true});
  EXPECT_EQ(m.bodies[1].velocity.linear, m.rows[0].n);
}

}  // namespace
}  // namespace carom
