#include "engine/simulation/bodies/step_view.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/simulation/world.h"

namespace carom {
namespace {

constexpr double kG = 9.81;

int addBox(World& world, const Vec3& size_m, const Vec3& position, bool is_static, double restitution = 0.0,
           const Vec3& velocity = Vec3::Zero()) {
  BodyDescription body{world.addSolid(Solid::box(size_m)), {}, Vec3::Zero(), Vec3::Zero(), {}, is_static};
  body.X_WB.position = position;
  body.material.restitution = restitution;
  body.linear_velocity = velocity;
  return world.addBody(body);
}

World pile() {
  World world(WorldSettings{});
  addBox(world, {20.0, 20.0, 1.0}, {0.0, 0.0, -0.5}, true);
  for (int i = 0; i < 8; ++i)
    addBox(world, {0.5, 0.4, 0.3}, {0.13 * (i % 3), 0.11 * (i % 2), 0.3 + 0.45 * i}, false, 0.2);
  EXPECT_TRUE(world.start().empty());
  return world;
}

TEST(StepView, WatchingChangesNoBit) {
  World watched = pile(), alone = pile();
  StepView view;
  watched.watch(&view);
  std::size_t seen = 0;
  for (int i = 0; i < 400; ++i) {
    watched.step();
    alone.step();
    seen += view.lasting.size() + view.collisions.size();
    ASSERT_EQ(watched.stateHash(), alone.stateHash()) << i;
  }
  EXPECT_GT(seen, 1000u);
}

// A ball that falls by h reaches the speed sqrt(2 g h) and leaves with e times it: m (1 + e) sqrt(2 g h).
TEST(StepView, ACollisionTakesTheImpulseOfTheClosedFormAtItsTimeAndPlace) {
  World world({1.0 / 240.0, Vec3(0.0, 0.0, -kG), true});
  addBox(world, {4.0, 4.0, 1.0}, {0.0, 0.0, -0.5}, true);
  BodyDescription ball{world.addSolid(Solid::ball(0.2)), {}, Vec3::Zero(), Vec3::Zero(), {}, false};
  ball.X_WB.position = Vec3(0.3, -0.4, 1.2);
  ball.material.restitution = 0.5;
  world.addBody(ball);
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  while (view.collisions.empty() && world.time() < 1.0) world.step();
  ASSERT_EQ(view.collisions.size(), 1u);
  const ContactView& hit = view.collisions[0];
  EXPECT_EQ(hit.body_a, 0);
  EXPECT_EQ(hit.body_b, 1);
  const double fallen = 1.0 - hit.gap_m;  // the window solves it this much above the plate
  EXPECT_NEAR(hit.time_s, std::sqrt(2.0 * fallen / kG), 1e-9);
  EXPECT_NEAR(hit.impulse_W.z(), world.mass(1) * 1.5 * std::sqrt(2.0 * kG * fallen), 1e-6 * world.mass(1));
  EXPECT_LT(Vec2(hit.impulse_W.x(), hit.impulse_W.y()).norm(), 1e-9);
  EXPECT_LT((hit.n_W - Vec3::UnitZ()).norm(), 1e-12);
  // Halfway across the gap, below the ball, in either body's frame.
  EXPECT_LT((hit.p_A - Vec3(0.3, -0.4, 0.5 + 0.5 * hit.gap_m)).norm(), 1e-9);
  EXPECT_LT((hit.p_B - Vec3(0.0, 0.0, -0.2 - 0.5 * hit.gap_m)).norm(), 1e-9);
}

TEST(StepView, LastingContactsCarryTheWeightOfAStepAlsoAtRest) {
  World world({1.0 / 240.0, Vec3(0.0, 0.0, -kG), true});
  addBox(world, {4.0, 4.0, 1.0}, {0.0, 0.0, -0.5}, true);
  addBox(world, {0.6, 0.4, 0.3}, {0.0, 0.0, 0.151}, false);
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  const auto expectWeight = [&] {
    Vec3 sum = Vec3::Zero();
    for (const ContactView& contact : view.lasting) {
      sum += contact.impulse_W;
      const Vec3 p_W = world.states()[1].X_WB * contact.p_B;
      EXPECT_NEAR(p_W.z(), 0.0, 2e-3);
      EXPECT_NEAR(std::abs(p_W.x()), 0.3, 1e-6);
      EXPECT_NEAR(std::abs(p_W.y()), 0.2, 1e-6);
    }
    EXPECT_EQ(view.lasting.size(), 4u);
    const double weight = world.mass(1) * kG / 240.0;
    EXPECT_LT((sum - Vec3(0.0, 0.0, weight)).norm(), 1e-3 * weight);
  };
  for (int i = 0; i < 40; ++i) world.step();
  ASSERT_NE(world.states()[1].mode, Mode::kResting);
  expectWeight();
  for (int i = 0; i < 200; ++i) world.step();
  ASSERT_EQ(world.states()[1].mode, Mode::kResting);
  expectWeight();
}

// A box that turns about its lower edge, which comes down slowly: its rows stand where it is in the middle of
// the step, and so does what is shown of them, halfway across the gap there.
TEST(StepView, LastingContactsOfWhatTurnsAreShownHalfwayAcrossTheGapInMidStep) {
  constexpr double kStep = 1.0 / 240.0, kTilt = 0.4, kGap = 4e-4;
  World world({kStep, Vec3(0.0, 0.0, -kG), true});
  addBox(world, {4.0, 4.0, 1.0}, {0.0, 0.0, -0.5}, true);
  const Vec3 size(0.3, 0.4, 0.2);
  const Quat tilt(Eigen::AngleAxisd(kTilt, Vec3::UnitY()));
  const auto lowest = [&](const Quat& R_WB) {
    double z = 0.0;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) z = std::min(z, (R_WB * size.cwiseProduct(Vec3(x, 0.0, y))).z());
    return z;
  };
  BodyDescription box{world.addSolid(Solid::box(size)), {}, Vec3::Zero(), Vec3::Zero(), {}, false};
  box.X_WB = {tilt, Vec3(0.0, 0.0, kGap - lowest(tilt))};
  box.angular_velocity = Vec3(0.0, 1.5, 0.0);
  // The edge is slower than what counts as a collision.
  const Vec3 edge = tilt * Vec3(0.5 * size.x(), 0.0, -0.5 * size.z());
  box.linear_velocity = -box.angular_velocity.cross(edge) - Vec3(0.0, 0.0, 0.02);
  world.addBody(box);
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  world.step();
  ASSERT_EQ(view.lasting.size(), 2u);
  const Quat R_then = Quat(Eigen::AngleAxisd(kTilt + 0.5 * kStep * box.angular_velocity.y(), Vec3::UnitY()));
  const double gap_then = box.X_WB.position.z() + 0.5 * kStep * box.linear_velocity.z() + lowest(R_then);
  EXPECT_LT(gap_then, kGap - 4e-5);
  for (const ContactView& contact : view.lasting) EXPECT_NEAR(contact.p_A.z() - 0.5, 0.5 * gap_then, 1e-9);
}

// A block slides at 60 steps a second: four substeps bear a quarter of its weight each.
TEST(StepView, LastingContactsCarryTheWeightOfAWholeStepAlsoInSubsteps) {
  World world({1.0 / 60.0, Vec3(0.0, 0.0, -kG), true});
  addBox(world, {40.0, 4.0, 1.0}, {0.0, 0.0, -0.5}, true);
  addBox(world, {0.6, 0.4, 0.3}, {0.0, 0.0, 0.1503}, false, 0.0, Vec3(2.0, 0.0, 0.0));
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  const double weight = world.mass(1) * kG / 60.0;
  for (int i = 0; i < 60; ++i) {
    world.step();
    double up = 0.0;
    for (const ContactView& contact : view.lasting) up += contact.impulse_W.z();
    EXPECT_NEAR(up, weight, 1e-3 * weight)
        << world.time() << " s, substeps " << world.audit().last_step.substeps;
  }
}

// A box comes to rest while another slides, in substeps; later, nothing is divided any more.
TEST(StepView, WhatRestsKeepsItsWeightWhateverTheSubsteps) {
  World world({1.0 / 60.0, Vec3(0.0, 0.0, -kG), true});
  addBox(world, {40.0, 4.0, 1.0}, {0.0, 0.0, -0.5}, true);
  addBox(world, {0.6, 0.4, 0.3}, {0.0, 0.0, 0.1503}, false);
  addBox(world, {0.6, 0.4, 0.3}, {2.0, 0.0, 0.1503}, false, 0.0, Vec3(3.0, 0.0, 0.0));
  ASSERT_TRUE(world.start().empty());
  StepView view;
  world.watch(&view);
  const double weight = world.mass(1) * kG / 60.0;
  int rested_in_substeps = 0;
  for (int i = 0; i < 120; ++i) {
    world.step();
    double up = 0.0;
    for (const ContactView& contact : view.lasting)
      if (contact.body_b == 1) up += contact.impulse_W.z();
    EXPECT_NEAR(up, weight, 1e-3 * weight) << world.time() << " s";
    rested_in_substeps += world.states()[1].mode == Mode::kResting && world.audit().last_step.substeps > 1;
  }
  EXPECT_GT(rested_in_substeps, 10);
  EXPECT_EQ(world.audit().last_step.substeps, 1);
}

TEST(StepView, SweptBoundsHoldTheBodyThroughoutTheStepAndCandidatesAreThoseThatMeet) {
  World world = pile();
  StepView view;
  world.watch(&view);
  EXPECT_EQ(view.swept.size(), world.bodies().size()) << "those of the start";
  for (int i = 0; i < 120; ++i) {
    const std::vector<BodyState> before(world.states().begin(), world.states().end());
    world.step();
    for (std::size_t body = 0; body < view.swept.size(); ++body)
      for (const std::span<const BodyState> states : {std::span<const BodyState>(before), world.states()}) {
        const Solid& solid = world.solids()[static_cast<std::size_t>(world.bodies()[body].solid)];
        for (const Vec3& v : solid.parts()[0].core.vertices()) {
          const Vec3 p_W = states[body].X_WB * v;
          ASSERT_TRUE((p_W.array() >= view.swept[body].low.array()).all() &&
                      (p_W.array() <= view.swept[body].high.array()).all())
              << i << " body " << body;
        }
      }
    ASSERT_EQ(view.candidates.size(), static_cast<std::size_t>(world.audit().last_step.candidate_pairs)) << i;
  }
}

}  // namespace
}  // namespace carom
