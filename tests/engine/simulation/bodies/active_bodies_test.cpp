// What a step looks at, counted: it does not grow with what rests.

#include "engine/simulation/bodies/active_bodies.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "engine/simulation/world.h"

namespace carom {
namespace {

constexpr int kFlying = 5;
constexpr double kFlight_s = 3.0;

Vec3 stackPosition(int i) {
  return {2.0 * (i % 20), 2.0 * (i / 20), 0.0};
}

// Five boxes that come down beside and on the first of some stacks of two, when these have long come to rest.
World flyersOverStacks(int stacks, int threads = 1) {
  World world({.step_s = 1.0 / 240, .threads = threads});  // so short that none is divided
  const int box = world.addSolid(Solid::box(Vec3(0.5, 0.4, 0.3)));
  const int floor = world.addSolid(Solid::box({100, 100, 1}));
  const auto add = [&](int solid, const Vec3& p, const Vec3& velocity, bool is_static) {
    world.addBody({solid, {Quat::Identity(), p}, velocity, Vec3::Zero(), Material{}, is_static});
  };
  add(floor, {30, 30, -0.5}, Vec3::Zero(), true);
  const double up = 0.5 * kFlight_s * world.settings().gravity.norm();
  for (int i = 0; i < kFlying; ++i) add(box, Vec3(0.01 * i, 0.02 * i, 1.0 + 0.6 * i), Vec3(0, 0, up), false);
  for (int i = 0; i < stacks; ++i)
    for (int level = 0; level < 2; ++level)
      add(box, stackPosition(i) + Vec3(0, 0, 0.1503 + 0.3003 * level), Vec3::Zero(), false);
  EXPECT_TRUE(world.start().empty());
  return world;
}

StepCounters stepTo(World& world, double time_s) {
  while (world.time() < time_s) world.step();
  return world.audit().last_step;
}

void expectSameWork(const StepCounters& few, const StepCounters& many) {
  EXPECT_EQ(few.active_bodies, many.active_bodies);
  EXPECT_EQ(few.active_pairs, many.active_pairs);
  EXPECT_EQ(few.distance_queries, many.distance_queries);
  EXPECT_EQ(few.contact_points, many.contact_points);
  EXPECT_EQ(few.rest_test_rows, many.rest_test_rows);
}

TEST(ActiveBodies, AreThoseThatMove_HoweverManyRest) {
  World few = flyersOverStacks(2), many = flyersOverStacks(400);
  const StepCounters in_flight = stepTo(many, 2.0);
  expectSameWork(stepTo(few, 2.0), in_flight);
  EXPECT_EQ(many.audit().resting_bodies, 800);
  EXPECT_EQ(in_flight.active_bodies, kFlying);
  EXPECT_GE(in_flight.candidate_pairs, 800) << "the pairs of what rests are kept";
  EXPECT_LE(in_flight.active_pairs, kFlying * (kFlying - 1) / 2);
}

// And what comes down wakes what it meets, not what lies beside that.
TEST(ActiveBodies, AreThoseThatWake_HoweverManyRest) {
  World few = flyersOverStacks(2), many = flyersOverStacks(400);
  int most = 0;
  stepTo(few, 2.0);
  stepTo(many, 2.0);
  while (many.time() < kFlight_s + 2.0) {
    few.step();
    many.step();
    expectSameWork(few.audit().last_step, many.audit().last_step);
    most = std::max(most, many.audit().last_step.active_bodies);
  }
  EXPECT_GT(most, kFlying) << "the first stack wakes";
  EXPECT_LE(most, kFlying + 2);
}

// The same bits for the bodies that both worlds have, asleep, woken and asleep again.
TEST(ActiveBodies, GoOnAsWithoutWhatRestsBesideThem) {
  World few = flyersOverStacks(2), many = flyersOverStacks(60), by_two = flyersOverStacks(60, 2);
  for (int step = 0; step < 1600; ++step) {
    for (World* world : {&few, &many, &by_two}) world->step();
    ASSERT_EQ(many.stateHash(), by_two.stateHash()) << step;
    for (std::size_t i = 0; i < few.states().size(); ++i) {
      const BodyState& x = few.states()[i];
      const BodyState& y = many.states()[i];
      ASSERT_EQ(x.X_WB.position, y.X_WB.position) << "step " << step << " body " << i;
      ASSERT_EQ(x.X_WB.rotation.coeffs(), y.X_WB.rotation.coeffs()) << "step " << step << " body " << i;
      ASSERT_EQ(x.mode, y.mode) << "step " << step << " body " << i;
    }
  }
  EXPECT_EQ(few.audit().resting_bodies, kFlying + 4) << "all sleep in the end";
}

// A ring of three that rests, and a fourth by itself.
TEST(ActiveBodies, AreDroppedAfterAWholeStepAtRest_AndWakeTogether) {
  std::vector<Body> bodies(4);
  ActiveBodies active;
  for (int i = 0; i < 4; ++i) active.add(i);
  const auto listed = [&] { return std::vector<int>(active.list().begin(), active.list().end()); };
  active.beginStep(bodies);
  for (const int i : {0, 2, 3}) bodies[static_cast<std::size_t>(i)].resting = true;
  bodies[0].next_at_rest = 2;
  bodies[2].next_at_rest = 3;
  bodies[3].next_at_rest = 0;
  EXPECT_EQ(listed(), (std::vector<int>{0, 1, 2, 3}));
  active.beginStep(bodies);
  EXPECT_EQ(listed(), (std::vector<int>{0, 1, 2, 3})) << "they are brought to rest";
  active.beginStep(bodies);
  EXPECT_EQ(listed(), std::vector<int>{1});
  EXPECT_FALSE(bodies[2].active);
  EXPECT_EQ(active.wakeIsland(bodies, 2).size(), 3u);
  EXPECT_EQ(listed(), (std::vector<int>{0, 1, 2, 3}));
  for (const Body& body : bodies) EXPECT_TRUE(body.moves() && body.active);
  EXPECT_THROW(active.wakeIsland(bodies, 1), ContractViolation) << "it does not rest";
}

}  // namespace
}  // namespace carom
