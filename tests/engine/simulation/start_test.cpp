// Starting poses: overlaps are named with their depth, touching bodies are moved apart upwards, the rest is
// left alone.

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

class Start : public testing::Test {
 protected:
  int box(const Vec3& size, const Vec3& position, bool is_static = false,
          const Quat& turn = Quat::Identity()) {
    BodyDescription d;
    d.solid = world_.addSolid(Solid::box(size));
    d.X_WB = {turn, position};
    d.is_static = is_static;
    return world_.addBody(d);
  }
  Vec3 position(int body) const { return world_.states()[static_cast<std::size_t>(body)].X_WB.position; }

  World world_{WorldSettings{}};
};

TEST_F(Start, NamesOverlappingBodiesDeepestFirst) {
  const int ground = box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  const int shallow = box({1, 1, 1}, Vec3(-3, 0, 0.48));
  const int deep = box({1, 1, 1}, Vec3(3, 0, 0.2));
  box({1, 1, 1}, Vec3(0, 0, 0.6));
  const std::vector<Overlap> overlaps = world_.start();
  ASSERT_EQ(overlaps.size(), 2u);
  EXPECT_EQ(overlaps[0].body_a, ground);
  EXPECT_EQ(overlaps[0].body_b, deep);
  EXPECT_NEAR(overlaps[0].depth_m, 0.3, 1e-12);
  EXPECT_EQ(overlaps[1].body_b, shallow);
  EXPECT_NEAR(overlaps[1].depth_m, 0.02, 1e-12);
}

TEST_F(Start, NamesABodyInsideAnother) {
  box({10, 10, 10}, Vec3::Zero(), true);
  box({1, 1, 1}, Vec3(1, 2, 3));
  const std::vector<Overlap> overlaps = world_.start();
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_NEAR(overlaps[0].depth_m, 2.5, 1e-12);
}

TEST_F(Start, LetsStaticBodiesOverlapEachOther) {
  box({10, 10, 1}, Vec3::Zero(), true);
  box({1, 10, 10}, Vec3(5, 0, 0), true);
  box({1, 1, 1}, Vec3(0, 0, 3));
  EXPECT_TRUE(world_.start().empty());
}

TEST_F(Start, LeavesBodiesApartWhereTheyAre) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  const int b = box({1, 1, 1}, Vec3(0.1, 0.2, 0.5003), false, oracle::turned(Vec3::UnitZ(), 0.3));
  EXPECT_TRUE(world_.start().empty());
  EXPECT_EQ(position(b), Vec3(0.1, 0.2, 0.5003)) << "0.3 mm is above the floor of the window";
}

TEST_F(Start, OpensExactTouchUpwards) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  std::vector<int> tower;
  for (int i = 0; i < 5; ++i)
    tower.push_back(box({1, 1, 1}, Vec3(0, 0, 0.5 + i), false, oracle::turned(Vec3::UnitZ(), 0.2 * i)));
  ASSERT_TRUE(world_.start().empty());
  EXPECT_GT(oracle::smallestGap(world_).gap_m, 0.19e-3);
  for (int i = 0; i < 5; ++i) {
    const Vec3 moved = position(tower[static_cast<std::size_t>(i)]) - Vec3(0, 0, 0.5 + i);
    EXPECT_GT(moved.z(), 0.0);
    EXPECT_LT(moved.z(), (i + 1) * 1e-3);
    EXPECT_LT(moved.head<2>().norm(), 1e-9);
  }
  for (int i = 0; i < 100; ++i) {
    world_.step();
    ASSERT_GT(world_.audit().smallest_gap_m, 0.0) << i;
  }
}

TEST_F(Start, OpensTouchSideBySideToo) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  box({1, 10, 10}, Vec3(-5.5, 0, 5), true);
  const int in_corner = box({1, 1, 1}, Vec3(-4.5, 0, 0.5));
  const int beside = box({1, 1, 1}, Vec3(-3.5, 0, 0.5));
  ASSERT_TRUE(world_.start().empty());
  EXPECT_GT(oracle::smallestGap(world_).gap_m, 0.19e-3);
  EXPECT_LT((position(in_corner) - Vec3(-4.5, 0, 0.5)).norm(), 2e-3);
  EXPECT_LT((position(beside) - Vec3(-3.5, 0, 0.5)).norm(), 4e-3);
}

TEST_F(Start, TakesRoundingForTouchButNotAMicrometre) {
  box({10, 10, 1}, Vec3(0, 0, -0.5), true);
  box({1, 1, 1}, Vec3(0, 0, 0.5 - 1e-12));
  EXPECT_TRUE(world_.start().empty());
  World deeper{WorldSettings{}};
  const int solid = deeper.addSolid(Solid::box({1, 1, 1}));
  deeper.addBody({solid, {Quat::Identity(), Vec3(0, 0, 0)}, Vec3::Zero(), Vec3::Zero(), {}, true});
  deeper.addBody({solid, {Quat::Identity(), Vec3(0, 0, 1 - 1e-6)}, Vec3::Zero(), Vec3::Zero(), {}, false});
  EXPECT_EQ(deeper.start().size(), 1u);
}

TEST_F(Start, IsNeededBeforeTheFirstStepAndOnlyOnce) {
  box({1, 1, 1}, Vec3::Zero());
  EXPECT_THROW(world_.step(), ContractViolation);
  EXPECT_TRUE(world_.start().empty());
  EXPECT_THROW(world_.start(), ContractViolation);
  EXPECT_THROW(world_.addSolid(Solid::ball(1)), ContractViolation);
}

}  // namespace
}  // namespace carom
