// Sweeps by several threads: what one thread gets, to the bit.

#include "engine/response/sweeps/shared_sweeps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/response/conjugate_sweeps.h"
#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/dissection.h"
#include "tests/engine/response/sweeps/masonry.h"

namespace carom {
namespace {

// A wall whose rows stand as those of a dissected crowd do.
Masonry dissectedWall(int courses, int length, int levels) {
  Masonry m = wall(courses, length);
  std::vector<int> members, part_of(m.bodies.size(), kNoPart);
  for (std::size_t i = 1; i < m.bodies.size(); ++i) members.push_back(static_cast<int>(i));
  const std::vector<Vec3> level{Vec3::UnitX(), Vec3::UnitY()};
  dissect({m.bodies, level, levels}, members, part_of);
  for (ContactRow& row : m.rows) row.part = commonPart(part_of[at(row.a)], part_of[at(row.b)]);
  std::stable_sort(m.rows.begin(), m.rows.end(),
                   [](const ContactRow& a, const ContactRow& b) { return a.part > b.part; });
  return m;
}

void expectSameBits(const Masonry& a, const Masonry& b) {
  for (std::size_t i = 0; i < a.rows.size(); ++i) ASSERT_EQ(a.rows[i].impulse, b.rows[i].impulse) << i;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    ASSERT_EQ(a.bodies[i].velocity.linear, b.bodies[i].velocity.linear) << i;
    ASSERT_EQ(a.bodies[i].velocity.angular, b.bodies[i].velocity.angular) << i;
  }
}

void expectSame(const SolverReport& a, const SolverReport& b) {
  EXPECT_EQ(a.sweeps, b.sweeps);
  EXPECT_EQ(a.visits, b.visits);
  EXPECT_EQ(a.residual_mps, b.residual_mps);
}

TEST(DissectedRows, OfDifferentPartsOfOneDepthShareNoBodyThatMoves) {
  const Masonry m = dissectedWall(20, 40, 3);
  std::set<int> depths;
  for (const ContactRow& row : m.rows) depths.insert(depthOf(row.part));
  EXPECT_EQ(depths.size(), 4u);
  std::vector<std::set<int>> parts_of(m.bodies.size());
  for (const ContactRow& row : m.rows)
    for (const int body : {row.a, row.b})
      if (m.bodies[at(body)].inverse_mass > 0.0) parts_of[at(body)].insert(row.part);
  for (const std::set<int>& parts : parts_of)
    for (const int part : parts)
      EXPECT_EQ(std::count_if(parts.begin(), parts.end(), [&](int p) { return depthOf(p) == depthOf(part); }),
                1);
}

class SharedSweepsOf : public testing::TestWithParam<int> {};

TEST_P(SharedSweepsOf, AreTheSweepsOfOneThreadBitForBit) {
  Masonry alone = dissectedWall(20, 40, 3), shared = alone;
  Crew crew(GetParam());
  SharedSweeps sweeps(shared.rows, shared.bodies, &crew);
  for (const bool friction : {true, false})
    for (int k = 0; k < 10; ++k) {
      SolverReport a, b;
      const Sweep sweep{.friction = friction, .forward = k % 2 == 0};
      sweepRows(alone.rows, alone.bodies, sweep, a);
      sweeps.sweep(sweep, b);
      expectSame(a, b);
      expectSameBits(alone, shared);
    }
}

// What is not stirred is passed over in the same rows.
TEST_P(SharedSweepsOf, OfASolve_AreThoseOfOneThreadBitForBit) {
  Masonry alone = dissectedWall(20, 40, 3), shared = alone;
  Crew crew(GetParam());
  SolverSettings settings{.sweeps = 60, .residual_mps = 1e-3 * kGained};
  const SolverReport a = solveContacts(alone.rows, alone.bodies, settings);
  settings.crew = &crew;
  expectSame(a, solveContacts(shared.rows, shared.bodies, settings));
  EXPECT_LT(a.visits, 60 * static_cast<long>(alone.rows.size())) << "all rows were visited each time";
  expectSameBits(alone, shared);
}

TEST_P(SharedSweepsOf, ConjugateDirections_AreThoseOfOneThreadBitForBit) {
  Masonry alone = dissectedWall(20, 40, 3), shared = alone;
  Crew crew(GetParam());
  const SolverSettings settings{.sweeps = 30, .residual_mps = 1e-12};
  expectSame(ConjugateSweeps(alone.rows, alone.bodies).solve(settings),
             ConjugateSweeps(shared.rows, shared.bodies, &crew).solve(settings));
  expectSameBits(alone, shared);
}

TEST_P(SharedSweepsOf, ACrowdThatIsStruck_AreThoseOfOneThreadBitForBit) {
  Masonry alone = dissectedWall(20, 40, 3);
  solveStandingContacts(alone.rows, alone.bodies, {.sweeps = 20, .residual_mps = 1e-8 * kGained});
  alone.bodies[100].velocity.linear += Vec3(0.3, 0.1, -0.3);
  Masonry shared = alone;
  Crew crew(GetParam());
  SolverSettings settings{.sweeps = 200, .residual_mps = 1e-6 * kGained};
  const SolverReport a = solveContactsFinely(alone.rows, alone.bodies, settings);
  settings.crew = &crew;
  expectSame(a, solveContactsFinely(shared.rows, shared.bodies, settings));
  expectSameBits(alone, shared);
}

INSTANTIATE_TEST_SUITE_P(Threads, SharedSweepsOf, testing::Values(1, 2, 3, 5));

// Cutting a crowd upright changes the order of its sweeps, not how far they come.
TEST(SharedSweeps, OfADissectedCrowd_ComeAsFarAsThoseInItsOwnOrder) {
  Masonry whole = wall(12, 40), parts = dissectedWall(12, 40, 3);
  const SolverSettings settings{.sweeps = 200, .residual_mps = 1e-9 * kGained};
  const SolverReport a = solveContactsFinely(whole.rows, whole.bodies, settings);
  const SolverReport b = solveContactsFinely(parts.rows, parts.bodies, settings);
  EXPECT_LT(b.residual_mps, 1.5 * a.residual_mps);
  EXPECT_LT(parts.fastest(), 1.5 * whole.fastest());
  expectWithinCones(parts);
}

}  // namespace
}  // namespace carom
