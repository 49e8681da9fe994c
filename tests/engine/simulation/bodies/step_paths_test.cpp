// Where the bodies are between two steps: on the paths that were proven to be apart.

#include "engine/simulation/bodies/step_paths.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "engine/contact/collision_window.h"
#include "engine/simulation/world.h"
#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

constexpr double kG = 9.81;
/// What 7, 11 and 97 pictures a second leave between steps, and as near to the ends as matters.
constexpr std::array<double, 6> kShares = {1e-6, 1.0 / 7.0, 4.0 / 11.0, 55.0 / 97.0, 6.0 / 7.0, 1.0 - 1e-6};

int add(World& world, Solid solid, const Pose& X_WB, const Material& material,
        const Velocity& velocity = Velocity{}, bool is_static = false) {
  return world.addBody(
      {world.addSolid(std::move(solid)), X_WB, velocity.linear, velocity.angular, material, is_static});
}

// Balls, boxes and fast spinning rods pour into a bin, bounce, roll and come to rest.
World poured(double rate_hz) {
  World world({1.0 / rate_hz, Vec3(0.0, 0.0, -kG), true});
  const Material bouncy{0.4, 0.4, 0.6, 1000.0}, dull{0.5, 0.5, 0.0, 1000.0};
  add(world, Solid::box({6, 6, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, dull, {}, true);
  for (const double side : {-1.0, 1.0}) {
    add(world, Solid::box({0.4, 3, 3}), {Quat::Identity(), Vec3(0.9 * side, 0, 1.6)}, dull, {}, true);
    add(world, Solid::box({1.2, 0.4, 3}), {Quat::Identity(), Vec3(0, 0.9 * side, 1.6)}, dull, {}, true);
  }
  oracle::Random random(11);
  for (int i = 0; i < 15; ++i) {
    const Pose X{random.rotation(), Vec3(0.7 * (i % 2) - 0.35, 0.5 * (i / 2 % 2) - 0.25, 0.6 + 0.45 * i)};
    const Velocity velocity{Vec3(0, 0, -4.0), 20.0 * random.direction()};
    if (i % 3 == 0)
      add(world, Solid::ball(0.15), X, bouncy, velocity);
    else if (i % 3 == 1)
      add(world, Solid::box({0.3, 0.2, 0.4}), X, dull, velocity);
    else
      add(world, Solid::box({0.05, 0.06, 0.6}), X, bouncy, velocity);
  }
  EXPECT_TRUE(world.start().empty());
  return world;
}

// Of the pair that may come closest: the smallest floor in the world.
double smallestFloor(const World& world) {
  double floor_m = std::numeric_limits<double>::infinity();
  for (const Solid& a : world.solids())
    for (const ConvexPart& part : a.parts()) floor_m = std::min(floor_m, collisionWindow(part, part).floor);
  return floor_m;
}

double smallestGap(const World& world, const std::vector<BodyState>& states,
                   oracle::RememberedAxes& remembered) {
  std::vector<oracle::PlacedSolid> placed;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyDescription& body = world.bodies()[i];
    placed.push_back({&world.solids()[static_cast<std::size_t>(body.solid)], states[i].X_WB, body.is_static});
  }
  return oracle::smallestGap(placed, &remembered).gap_m;
}

class StepPathsAt : public testing::TestWithParam<double> {};

TEST_P(StepPathsAt, KeepEveryPairApartAtEveryInstant) {
  World world = poured(GetParam());
  world.keepPaths(true);
  oracle::RememberedAxes remembered;
  std::vector<BodyState> states;
  double smallest = std::numeric_limits<double>::infinity();
  int events = 0;
  while (world.time() < 1.5) {
    world.step();
    events += world.audit().last_step.events;
    for (const double share : kShares) {
      world.statesWithin(share, states);
      smallest = std::min(smallest, smallestGap(world, states, remembered));
    }
  }
  EXPECT_GT(events, 200);
  // The search and the oracle see coordinates below 8 m, each rounded a few times.
  EXPECT_GE(smallest, smallestFloor(world) - 1e-13);
}

TEST_P(StepPathsAt, BeginAndEndWhereTheStepDoes) {
  World world = poured(GetParam());
  world.keepPaths(true);
  std::vector<BodyState> before, states;
  int substeps = 1;
  // Until a body has come to rest, whose path has no length.
  while (world.time() < 3.0 || (world.audit().resting_bodies == 0 && world.time() < 8.0)) {
    before.assign(world.states().begin(), world.states().end());
    world.step();
    substeps = std::max(substeps, world.audit().last_step.substeps);
    for (const double share : {0.0, 1.0}) {
      world.statesWithin(share, states);
      const std::span<const BodyState> expected = share == 0.0 ? before : world.states();
      for (std::size_t i = 0; i < states.size(); ++i) {
        ASSERT_EQ(states[i].X_WB.position, expected[i].X_WB.position) << world.time() << ' ' << i;
        ASSERT_EQ(states[i].X_WB.rotation.coeffs(), expected[i].X_WB.rotation.coeffs()) << i;
        ASSERT_EQ(states[i].mode, world.states()[i].mode);
      }
    }
  }
  EXPECT_GT(world.audit().resting_bodies, 0);
  EXPECT_EQ(substeps > 1, GetParam() < 240.0);
}

TEST_P(StepPathsAt, KeepingThemChangesNoBit) {
  World keeping = poured(GetParam()), plain = poured(GetParam());
  std::vector<BodyState> states;
  for (int i = 0; i < GetParam(); ++i) {
    keeping.keepPaths(i % 3 != 0);
    keeping.step();
    if (i % 3 != 0) keeping.statesWithin(0.5, states);
    plain.step();
    ASSERT_EQ(keeping.stateHash(), plain.stateHash()) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, StepPathsAt, testing::Values(60.0, 240.0));

// Falls by z, leaves at e times its speed, and is on the two parabolas throughout, with their velocities; at
// every instant, and turned back at that of the blow, whatever the step.
TEST(StepPaths, ABallThatBouncesIsOnTheParabolasOfTheClosedForm) {
  constexpr double kRestitution = 0.7, kHeight = 1.0;
  for (const double rate : {30.0, 60.0, 240.0}) {
    World world({1.0 / rate, Vec3(0.0, 0.0, -kG), true});
    const Material bouncy{0.0, 0.0, kRestitution, 1000.0};
    add(world, Solid::box({4, 4, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, bouncy, {}, true);
    const int ball = add(world, Solid::ball(0.2), {Quat::Identity(), Vec3(0.3, 0.1, 0.2 + kHeight)}, bouncy,
                         {Vec3(0.5, 0, 0), Vec3::Zero()});
    ASSERT_TRUE(world.start().empty());
    StepView view;
    world.watch(&view);
    world.keepPaths(true);
    std::vector<BodyState> states;
    for (int step = 0; world.time() < 0.8; ++step) {
      world.step();
      const bool has_hit = !view.collisions.empty();
      // Struck this far above the floor.
      const double fallen = kHeight - (has_hit ? view.collisions.front().gap_m : 0.0);
      const double hit_s = std::sqrt(2.0 * fallen / kG), back = kRestitution * kG * hit_s;
      for (const double share : kShares) {
        world.statesWithin(share, states);
        const BodyState& state = states[static_cast<std::size_t>(ball)];
        const double t = (step + share) / rate, since = t - hit_s;
        const bool after = has_hit && since > 0.0;
        const double z = after ? 0.2 + kHeight - fallen + back * since - 0.5 * kG * since * since
                               : 0.2 + kHeight - 0.5 * kG * t * t;
        const double v = after ? back - kG * since : -kG * t;
        ASSERT_LT((state.X_WB.position - Vec3(0.3 + 0.5 * t, 0.1, z)).norm(), 1e-9) << rate << ' ' << t;
        ASSERT_LT((state.linear_velocity - Vec3(0.5, 0, v)).norm(), 1e-6) << rate << ' ' << t;
      }
    }
    EXPECT_EQ(view.collisions.size(), 1u);
  }
}

// A box that rests is struck by a ball within a step: until then it lies where it lay.
TEST(StepPaths, WhatLiesIsStruckAtTheInstantOfTheBlow) {
  World world({1.0 / 60.0, Vec3(0.0, 0.0, -kG), true});
  const Material smooth{0.3, 0.3, 0.5, 1000.0};
  add(world, Solid::box({9, 9, 1}), {Quat::Identity(), Vec3(0, 0, -0.5)}, smooth, {}, true);
  const int box = add(world, Solid::box({0.4, 0.4, 0.4}), {Quat::Identity(), Vec3(0, 0, 0.2005)}, smooth);
  const int ball = add(world, Solid::ball(0.1), {Quat::Identity(), Vec3(-0.3, 0, 9.5)}, smooth,
                       {Vec3(0.07, 0, 0), Vec3::Zero()});
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  world.keepPaths(true);
  std::vector<BodyState> states;
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  while (world.time() < 2.0 && view.collisions.empty()) world.step();
  ASSERT_FALSE(view.collisions.empty());
  const ContactView& hit = view.collisions.front();
  ASSERT_EQ(hit.body_a, box);
  ASSERT_EQ(hit.body_b, ball);
  const double hit_share = (hit.time_s - (world.time() - 1.0 / 60.0)) * 60.0;
  ASSERT_GT(hit_share, 0.01);
  ASSERT_LT(hit_share, 0.99);
  world.statesWithin(hit_share - 1e-6, states);
  const BodyState lying = states[index(box)];
  EXPECT_EQ(lying.linear_velocity, Vec3::Zero());
  EXPECT_LT(states[index(ball)].linear_velocity.z(), -10.0) << "not yet";
  world.statesWithin(0.0, states);
  EXPECT_EQ(states[index(box)].X_WB.position, lying.X_WB.position);
  world.statesWithin(hit_share + 1e-6, states);
  EXPECT_GT(states[index(ball)].linear_velocity.z(), 1.0) << "on its way back";
}

}  // namespace
}  // namespace carom
