// A step of flight over a world at rest allocates nothing: counted through the program's own operator new.

#include <gtest/gtest.h>

#include "engine/simulation/world.h"
#include "tests/oracle/allocations.h"

namespace carom {
namespace {

TEST(NoAllocationInAStep, OfFlightOverWhatRests) {
#ifndef NDEBUG
  GTEST_SKIP() << "this build certifies each answer, which allocates";
#endif
  World world({.step_s = 1.0 / 60});
  const int box = world.addSolid(Solid::box({0.5, 0.4, 0.3}));
  const int floor = world.addSolid(Solid::box({100, 100, 1}));
  const auto add = [&](int solid, const Vec3& p, const Vec3& velocity, bool is_static) {
    world.addBody({solid, {Quat::Identity(), p}, velocity, Vec3(1, 2, 3), Material{}, is_static});
  };
  add(floor, {0, 0, -0.5}, Vec3::Zero(), true);
  for (int i = 0; i < 10; ++i) add(box, Vec3(0.8 * i, 0, 5), Vec3(0, 0, 30), false);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(0.8 * (i % 10), 0.8 * (i / 10), 0.1503);
    world.addBody({box, {Quat::Identity(), p}, Vec3::Zero(), Vec3::Zero(), Material{}, false});
  }
  ASSERT_TRUE(world.start().empty());
  while (world.time() < 2.0) world.step();
  ASSERT_EQ(world.audit().resting_bodies, 100);
  for (int step = 0; step < 60; ++step) EXPECT_EQ(oracle::allocationsOf([&] { world.step(); }), 0) << step;
}

}  // namespace
}  // namespace carom
