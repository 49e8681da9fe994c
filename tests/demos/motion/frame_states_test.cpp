#include "demos/motion/frame_states.h"

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "tests/oracle/overlap_oracle.h"

namespace carom::demos {
namespace {

const Vec3 kThrown(3.0, -2.0, 1.0);
const Vec3 kGravity(0.0, 0.0, -9.81);

/// A thrown ball, whose place at every instant has a closed form.
World flyingBall(double rate_hz) {
  WorldSettings settings;
  settings.step_s = 1.0 / rate_hz;
  settings.gravity = kGravity;
  World world(settings);
  BodyDescription body;
  body.solid = world.addSolid(Solid::ball(0.5));
  body.linear_velocity = kThrown;
  world.addBody(body);
  EXPECT_TRUE(world.start().empty());
  return world;
}

TEST(FrameStates, ShowEachFrameAtItsExactTime) {
  for (const double rate : {240.0, 500.0, 100.0, 20.0})
    for (const double fps : {24.0, 30.0, 60.0, 7.0, 11.0, 97.0}) {
      World world = flyingBall(rate);
      const FrameClock clock({fps, rate});
      int steps = 0;
      FrameStates states(world, clock, [&steps](const World&) { ++steps; });
      int frame = 0;
      for (; clock.time(frame) < 4.0; ++frame) {
        const double t = clock.time(frame);
        const BodyState& ball = states.advanceTo(frame)[0];
        // The world adds up at most 2000 steps, each rounded to half an ulp of positions below 128 m, and
        // what that many roundings of the velocity, below 64 m/s, make of 4 s.
        constexpr double kVelocity = 2000 * 3.6e-15, kPosition = 2000 * 7.2e-15 + 4.0 * kVelocity;
        EXPECT_LT((ball.X_WB.position - t * kThrown - 0.5 * t * t * kGravity).norm(), kPosition)
            << rate << ' ' << fps << ' ' << frame;
        EXPECT_LT((ball.linear_velocity - kThrown - t * kGravity).norm(), kVelocity)
            << rate << ' ' << fps << ' ' << frame;
      }
      EXPECT_EQ(steps, clock.instant(frame - 1).lastStepNeeded());
    }
}

/// The smallest gap in any of the frames of a scene's first 1.2 s.
double smallestShownGap(Scene scene, const FrameClock::Rates& rates) {
  scene.rate_hz = rates.steps_per_second;
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock(rates);
  FrameStates states(made.world, clock, [](const World&) {});
  oracle::RememberedAxes remembered;
  double smallest = std::numeric_limits<double>::infinity();
  for (int frame = 0; clock.time(frame) < 1.2; ++frame) {
    const std::span<const BodyState> shown = states.advanceTo(frame);
    std::vector<oracle::PlacedSolid> placed;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const BodyDescription& body = made.world.bodies()[i];
      placed.push_back(
          {&made.world.solids()[static_cast<std::size_t>(body.solid)], shown[i].X_WB, body.is_static});
    }
    smallest = std::min(smallest, oracle::smallestGap(placed, &remembered).gap_m);
  }
  return smallest;
}

TEST(FrameStates, NoFrameBetweenTwoStepsShowsAnOverlap) {
  for (const char* name : {"fifty-bodies", "spinning-coin"})
    for (const double rate : {60.0, 240.0})
      for (const double fps : {7.0, 11.0, 97.0})
        EXPECT_GT(smallestShownGap(readSceneFile(findScene(name)), {fps, rate}), 0.0)
            << name << ' ' << rate << ' ' << fps;
}

// A world that is asked for more frames than it makes steps.
TEST(FrameStates, AFrameAskedForTwiceAndSeveralInOneStepAreThoseAskedForAlone) {
  const FrameClock clock({240.0, 20.0});
  World world = flyingBall(20.0);
  FrameStates states(world, clock, [](const World&) {});
  for (int frame = 0; frame < 40; ++frame) {
    World other = flyingBall(20.0);
    FrameStates alone(other, clock, [](const World&) {});
    const Vec3 expected = alone.advanceTo(frame)[0].X_WB.position;
    for (int time = 0; time < 2; ++time)
      EXPECT_EQ(states.advanceTo(frame)[0].X_WB.position, expected) << frame;
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
