// What the contact solver spends on many small heaps at once: less on each than on one alone.

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/foundation/tolerances.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kSize = 0.5, kPitch = 0.9;

struct Work {
  long most_visits = 0;  ///< Of contact rows in a step.
  double smallest_gap_m = 0.0;
};

// Columns of tumbled boxes fall together, each on a place of its own.
Work workOfColumns(int columns) {
  World world({.step_s = tolerance::kFineStep});  // one that is not divided
  const int box = world.addSolid(Solid::box(Vec3::Constant(kSize)));
  const int floor = world.addSolid(Solid::box({500, 500, 1}));
  const Material material{0.1, 0.1, 0.0, 1000.0};
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), material, true});
  for (int i = 0; i < columns; ++i) {
    oracle::Random random(5);  // all alike
    for (int layer = 0; layer < 8; ++layer) {
      const Vec3 p(20.0 * (i % 8), 20.0 * (i / 8), kPitch * (layer + 0.6));
      world.addBody({box, {random.rotation(), p}, Vec3::Zero(), Vec3::Zero(), material, false});
    }
  }
  EXPECT_TRUE(world.start().empty());
  Work work;
  for (int step = 0; step < 280; ++step) {
    world.step();
    work.most_visits = std::max(work.most_visits, world.audit().last_step.row_visits);
  }
  work.smallest_gap_m = oracle::smallestGap(world).gap_m;
  return work;
}

TEST(SolverWork, OfManySmallHeapsIsBoundedForAllOfThem) {
  constexpr int kMany = 48;
  const Work one = workOfColumns(1), many = workOfColumns(kMany);
  EXPECT_GT(one.most_visits, tolerance::kSolverMostVisits) << "too easy for this test";
  EXPECT_LT(many.most_visits, kMany * one.most_visits / 3);
  EXPECT_GT(many.smallest_gap_m, 0.0);
}

}  // namespace
}  // namespace carom
