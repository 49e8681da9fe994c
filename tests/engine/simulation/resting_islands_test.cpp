// Coming to rest, by what is looked at for it.

#include "engine/foundation/tolerances.h"
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

// A ball that rolling resistance brakes until it is told to rest, when its friction, m a with
// a = 5/7 lever/radius g, has nothing left to do: from then on it is shown to press with its weight, to what
// may be left over of balanced forces.
TEST(RestingIslands, PressWithTheirWeightAloneWhateverBrakedThem) {
  constexpr double kBraking = 0.02, kRadius = 0.2, kG = 9.81, kStep = 1.0 / 240;
  World world({.step_s = kStep, .gravity = Vec3(0, 0, -kG)});
  Material material;
  material.rolling_resistance_m = 7.0 / 5.0 * kBraking / kG * kRadius;
  const int floor = world.addSolid(Solid::box({20, 20, 1}));
  const int ball = world.addSolid(Solid::ball(kRadius));
  world.addBody({floor, {Quat::Identity(), Vec3(0, 0, -0.5)}, Vec3::Zero(), Vec3::Zero(), material, true});
  const Vec3 velocity(0.45 * tolerance::kRestSpeed, 0, 0), spin(0, velocity.x() / kRadius, 0);
  world.addBody({ball, {Quat::Identity(), Vec3(0, 0, kRadius)}, velocity, spin, material, false});
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  const double weight = world.mass(1) * kG * kStep;
  double braked = 0.0;
  for (int step = 0; step < 100 && world.states()[1].mode != Mode::kResting; ++step) {
    EXPECT_GT(world.states()[1].linear_velocity.x(), 0.0);
    world.step();
    braked = view.lasting.at(0).impulse_W.x();
  }
  world.step();
  ASSERT_EQ(world.states()[1].mode, Mode::kResting);
  EXPECT_NEAR(braked, -world.mass(1) * kBraking * kStep, 0.01 * weight * kBraking / kG);
  ASSERT_EQ(view.lasting.size(), 1u);
  EXPECT_LT((view.lasting[0].impulse_W - Vec3(0, 0, weight)).norm(), tolerance::kRestAcceleration * weight);
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

// Pressed together by loads that cancel, with or without a weight that a force bears; and one alone.
TEST(RestingIslands, WhatNothingHoldsFliesOnHoweverSlowly) {
  for (const double weight_mps2 : {0.0, 9.81}) {
    World world({.step_s = 1.0 / 60, .gravity = {0.0, 0.0, -weight_mps2}});
    const int box = world.addSolid(Solid::box({1.0, 1.0, 1.0}));
    const Vec3 velocity(0.0, 1e-4, 0.0);
    for (const double force : {1.0, -1.0, 0.0}) {
      BodyDescription body;
      body.solid = box;
      body.X_WB.position = force == 0.0 ? Vec3(0.0, 0.0, 5.0) : Vec3(-0.5005 * force, 0.0, 0.0);
      body.linear_velocity = velocity;
      body.mass_kg = 10.0;
      body.load.force_W = {force, 0.0, 10.0 * weight_mps2};
      world.addBody(body);
    }
    ASSERT_TRUE(world.start().empty());
    for (int step = 0; step < 180; ++step) world.step();
    for (const BodyState& state : world.states()) {
      EXPECT_NE(state.mode, Mode::kResting);
      EXPECT_NEAR(state.linear_velocity.y(), velocity.y(), 1e-12);
      EXPECT_NEAR(state.X_WB.position.y(), 3.0 * velocity.y(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace carom
