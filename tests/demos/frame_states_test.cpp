#include "demos/frame_states.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

/// A ball in free flight without gravity: its position is linear in time, so that every frame has a closed
/// form.
World flyingBall(double rate_hz) {
  WorldSettings settings;
  settings.step_s = 1.0 / rate_hz;
  settings.gravity = Vec3::Zero();
  World world(settings);
  BodyDescription body;
  body.solid = world.addSolid(Solid::ball(0.5));
  body.linear_velocity = Vec3(3.0, -2.0, 1.0);
  world.addBody(body);
  EXPECT_TRUE(world.start().empty());
  return world;
}

TEST(FrameStates, ShowEachFrameAtItsExactTime) {
  for (const double rate : {240.0, 500.0, 100.0, 20.0})
    for (const double fps : {24.0, 30.0, 60.0}) {
      World world = flyingBall(rate);
      const FrameClock clock({fps, rate});
      int steps = 0;
      FrameStates states(world, clock, [&steps](const World&) { ++steps; });
      for (int frame = 0; frame < 100; ++frame) {
        const Vec3 expected = clock.time(frame) * Vec3(3.0, -2.0, 1.0);
        // The world adds up at most 2500 steps, each rounded to half an ulp of a position below 16 m.
        EXPECT_LT((states.advanceTo(frame)[0].X_WB.position - expected).norm(), 2500 * 1.8e-15)
            << rate << ' ' << fps << ' ' << frame;
      }
      EXPECT_EQ(steps, clock.instant(99).lastStepNeeded());
    }
}

TEST(FrameStates, DrawingNeverChangesThePhysics) {
  World plain = flyingBall(500.0);
  for (int i = 0; i < 500; ++i) plain.step();
  World drawn = flyingBall(500.0);
  const FrameClock clock({24.0, 500.0});
  FrameStates states(drawn, clock, [](const World&) {});
  for (int frame = 0; frame < 24; ++frame) states.advanceTo(frame);
  states.stepTo(500);
  EXPECT_EQ(drawn.stateHash(), plain.stateHash());
}

}  // namespace
}  // namespace carom::demos
