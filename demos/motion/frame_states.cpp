#include "demos/motion/frame_states.h"

#include "engine/foundation/contract.h"

namespace carom::demos {

FrameStates::FrameStates(World& world, const FrameClock& clock, AfterStep after_step, PhaseClock* phases)
    : world_(world), clock_(clock), after_step_(std::move(after_step)), phases_(phases) {}

void FrameStates::stepTo(int step) {
  while (world_.stepCount() < step) {
    world_.step(phases_);
    after_step_(world_);
  }
}

std::span<const BodyState> FrameStates::advanceTo(int frame) {
  const StepInstant instant = clock_.instant(frame);
  stepTo(instant.step);
  // More frames than steps a second: the world may already stand at the end of the step this instant lies in.
  if (instant.fraction > 0.0) {
    world_.keepPaths(true);
    stepTo(instant.lastStepNeeded());
    world_.keepPaths(false);
  }
  REQUIRE(world_.stepCount() == instant.lastStepNeeded(), frame, world_.stepCount());
  if (instant.fraction == 0.0) return world_.states();
  world_.statesWithin(instant.fraction, shown_);
  return shown_;
}

}  // namespace carom::demos
