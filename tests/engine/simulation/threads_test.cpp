// A large island stepped by several threads: what one gets, to the bit.

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kSize = 0.5, kGap = 0.0005;

// Boxes in layers, each on four of the layer below, and some that fall on top: enough in one island that
// it is dissected, and that other work of a step is shared out as well.
World bondedCrowd(int threads) {
  World world({.step_s = 1.0 / 60, .threads = threads});
  const int box = world.addSolid(Solid::box(Vec3::Constant(kSize)));
  const int floor = world.addSolid(Solid::box({40, 40, 1}));
  const Material material{0.5, 0.5, 0.0, 1000.0};
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), material, true});
  constexpr int kSide = 18, kLayers = 4;
  for (int layer = 0; layer < kLayers; ++layer)
    for (int i = 0; i < kSide - layer; ++i)
      for (int j = 0; j < kSide - layer; ++j) {
        const Vec3 p((kSize + 0.01) * (i + 0.5 * layer), (kSize + 0.01) * (j + 0.5 * layer),
                     (kSize + kGap) * layer + 0.5 * kSize + kGap);
        world.addBody({box, {Quat::Identity(), p}, Vec3::Zero(), Vec3::Zero(), material, false});
      }
  oracle::Random random(3);
  for (int i = 0; i < 10; ++i) {
    const Vec3 p(0.7 * i + 0.5, 0.5 * i + 0.6, 2.6 + 0.1 * i);
    world.addBody({box, {random.rotation(), p}, Vec3(0, 0, -2), Vec3::Zero(), material, false});
  }
  EXPECT_TRUE(world.start().empty());
  return world;
}

void expectSameCounters(const StepCounters& a, const StepCounters& b) {
  EXPECT_EQ(a.candidate_pairs, b.candidate_pairs);
  EXPECT_EQ(a.distance_queries, b.distance_queries);
  EXPECT_EQ(a.contact_points, b.contact_points);
  EXPECT_EQ(a.events, b.events);
  EXPECT_EQ(a.impacts, b.impacts);
  EXPECT_EQ(a.newton_steps, b.newton_steps);
  EXPECT_EQ(a.stopped_bodies, b.stopped_bodies);
  EXPECT_EQ(a.iteration_limits, b.iteration_limits);
}

TEST(Threads, ChangeNoBitOfACrowd) {
  World one = bondedCrowd(1), two = bondedCrowd(2), three = bondedCrowd(3);
  for (int step = 0; step < 24; ++step) {
    for (World* world : {&one, &two, &three}) world->step();
    if (step == 12) {
      EXPECT_GT(one.audit().last_step.contact_points, 8000) << "too few for this test";
    }
    for (const World* world : {&two, &three}) {
      ASSERT_EQ(world->stateHash(), one.stateHash()) << step;
      expectSameCounters(world->audit().last_step, one.audit().last_step);
    }
  }
  EXPECT_GT(oracle::smallestGap(two).gap_m, 0.0);
}

TEST(Threads, AreAtLeastOne) {
  EXPECT_THROW(World(WorldSettings{.threads = 0}), ContractViolation);
}

TEST(Threads, AreAsManyAsTheSettingsSay) {
  const std::filesystem::path tasks = "/proc/self/task";
  if (!std::filesystem::exists(tasks)) GTEST_SKIP() << "this system does not list a program's threads there";
  const auto running = [&] {
    return std::distance(std::filesystem::directory_iterator(tasks), std::filesystem::directory_iterator());
  };
  const auto before = running();
  World world = bondedCrowd(3);
  world.step();
  EXPECT_EQ(running(), before + 2) << "the caller is one of the three";
}

}  // namespace
}  // namespace carom
