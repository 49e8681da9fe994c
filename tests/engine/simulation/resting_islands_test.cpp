// Coming to rest, by what is looked at for it.

#include "engine/simulation/resting_islands.h"
#include "engine/simulation/world.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

// So many stacks of two boxes, apart from each other.
World stacks(int count, double density_kgpm3 = 1000.0) {
  World world({.step_s = 1.0 / 60});
  Material material;
  material.density_kgpm3 = density_kgpm3;
  const int box = world.addSolid(Solid::box(Vec3(0.5, 0.4, 0.3)));
  const int floor = world.addSolid(Solid::box({200, 20, 1}));
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), Material{}, true});
  for (int i = 0; i < count; ++i)
    for (int level = 0; level < 2; ++level) {
      const Vec3 p(1.1 * i - 90.0, 0.2 * (i % 3), 0.1503 + 0.3003 * level);
      world.addBody({box, {Quat::Identity(), p}, Vec3::Zero(), Vec3::Zero(), material, false});
    }
  EXPECT_TRUE(world.start().empty());
  return world;
}

// Until everything rests: how many rows were looked at for that in one step at most, and of how many.
struct Looked {
  int rows = 0;
  int contact_points = 0;
};
Looked mostLookedAt(World world, int bodies) {
  Looked most;
  for (int step = 0; step < 120 && world.audit().resting_bodies < bodies; ++step) {
    world.step();
    const StepCounters counters = world.audit().last_step;
    if (counters.rest_test_rows > most.rows) most = {counters.rest_test_rows, counters.contact_points};
  }
  EXPECT_EQ(world.audit().resting_bodies, bodies);
  return most;
}

TEST(RestingIslands, LookAtTheirOwnRowsOnly) {
  for (const int count : {1, 10, 100}) {
    const Looked most = mostLookedAt(stacks(count), 2 * count);
    EXPECT_EQ(most.rows, 8 * count) << "all stacks come to rest in one step";
    EXPECT_EQ(most.rows, most.contact_points);
  }
}

// However lightly they press: two stories are asked about together, and each row once.
TEST(RestingIslands, AreWholeStacksOfTheLightestBoxesToo) {
  const Looked most = mostLookedAt(stacks(10, 0.5), 20);
  EXPECT_EQ(most.rows, 80);
}

// What moves beside them is none of their business.
TEST(RestingIslands, LookAtNoRowOfWhatMoves) {
  World world({.step_s = 1.0 / 60});
  const int box = world.addSolid(Solid::box(Vec3(0.5, 0.4, 0.3)));
  const int floor = world.addSolid(Solid::box({200, 20, 1}));
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), Material{}, true});
  for (int i = 0; i < 20; ++i) {
    const Vec3 velocity = i == 0 ? Vec3::Zero() : Vec3(0, 9, 0);
    const Vec3 p(1.1 * i - 40.0, -9.0, 0.1503);
    world.addBody({box, {Quat::Identity(), p}, velocity, Vec3::Zero(), Material{}, false});
  }
  ASSERT_TRUE(world.start().empty());
  const Looked most = mostLookedAt(std::move(world), 1);
  EXPECT_EQ(most.rows, 4);
  EXPECT_EQ(most.contact_points, 80);
}

}  // namespace
}  // namespace carom
