// The world's phases: told in proper nesting, and told or not, the same bits.
#include "engine/simulation/bodies/phase_clock.h"

#include <array>

#include <gtest/gtest.h>

#include "engine/simulation/world.h"

namespace carom {
namespace {

class CountingClock : public PhaseClock {
 public:
  void begin(StepPhase phase) override {
    ++count_[static_cast<std::size_t>(phase)];
    deepest_ = std::max(deepest_, ++depth_);
  }
  void end() override { ASSERT_GE(--depth_, 0); }
  int count(StepPhase phase) const { return count_[static_cast<std::size_t>(phase)]; }
  int depth() const { return depth_; }
  int deepest() const { return deepest_; }

 private:
  std::array<int, kStepPhases> count_{};
  int depth_ = 0;
  int deepest_ = 0;
};

/// A ball and a turned box, falling on a floor.
World fallingWorld() {
  World world{WorldSettings{}};
  const int floor = world.addSolid(Solid::box({8.0, 8.0, 1.0}));
  const int box = world.addSolid(Solid::box({1.0, 0.7, 0.5}));
  const int ball = world.addSolid(Solid::ball(0.4));
  BodyDescription ground;
  ground.solid = floor;
  ground.is_static = true;
  ground.X_WB.position = Vec3(0.0, 0.0, -0.5);
  BodyDescription low;
  low.solid = box;
  low.X_WB = {Quat(0.9, 0.3, 0.2, 0.1).normalized(), Vec3(0.1, -0.2, 1.1)};
  low.material.restitution = 0.4;
  BodyDescription high = low;
  high.solid = ball;
  high.X_WB.position = Vec3(0.2, 0.0, 2.4);
  world.addBody(ground);
  world.addBody(low);
  world.addBody(high);
  EXPECT_TRUE(world.start().empty());
  return world;
}

TEST(PhaseClock, ListeningChangesNoBit) {
  World heard = fallingWorld(), unheard = fallingWorld();
  CountingClock clock;
  for (int step = 0; step < 480; ++step) {
    heard.step(&clock);
    unheard.step();
    ASSERT_EQ(heard.stateHash(), unheard.stateHash()) << step;
    ASSERT_EQ(clock.depth(), 0);
  }
}

TEST(PhaseClock, EveryPhaseIsToldAndCollisionsNestInTheSearchForThem) {
  World world = fallingWorld();
  CountingClock first;
  world.step(&first);
  for (const StepPhase phase : {StepPhase::kForces, StepPhase::kBroadPhase, StepPhase::kClosestFeatures,
                                StepPhase::kImpulses, StepPhase::kTimeOfImpact, StepPhase::kModes})
    EXPECT_GE(first.count(phase), 1) << static_cast<int>(phase);
  EXPECT_EQ(first.count(StepPhase::kTimeOfImpact), 1);
  int events = 0;
  for (int step = 0; step < 240; ++step) {
    CountingClock clock;
    world.step(&clock);
    if (world.audit().last_step.events == 0) continue;
    ++events;
    EXPECT_GE(clock.deepest(), 2);
    EXPECT_GE(clock.count(StepPhase::kImpulses), 1 + world.audit().last_step.events);
  }
  EXPECT_GT(events, 0);
}

}  // namespace
}  // namespace carom
