#include "demos/frame_states.h"

#include "engine/foundation/contract.h"

namespace carom::demos {

FrameStates::FrameStates(World& world, const FrameClock& clock, AfterStep after_step, PhaseClock* phases)
    : world_(world), clock_(clock), after_step_(std::move(after_step)), phases_(phases) {
  before_.assign(world.states().begin(), world.states().end());
}

void FrameStates::stepTo(int step) {
  while (world_.stepCount() < step) {
    before_.assign(world_.states().begin(), world_.states().end());
    world_.step(phases_);
    after_step_(world_);
  }
}

std::span<const BodyState> FrameStates::advanceTo(int frame) {
  const StepInstant instant = clock_.instant(frame);
  stepTo(instant.lastStepNeeded());
  // More frames than steps a second: the world may already stand at the end of the step this instant lies in.
  REQUIRE(world_.stepCount() == instant.lastStepNeeded(), frame, world_.stepCount());
  const std::span<const BodyState> now = world_.states();
  if (instant.fraction == 0.0) return now;
  shown_.assign(now.begin(), now.end());
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const double f = instant.fraction;
    shown_[i].X_WB = interpolated(before_[i].X_WB, now[i].X_WB, f);
    shown_[i].linear_velocity = (1.0 - f) * before_[i].linear_velocity + f * now[i].linear_velocity;
    shown_[i].angular_velocity = (1.0 - f) * before_[i].angular_velocity + f * now[i].angular_velocity;
  }
  return shown_;
}

}  // namespace carom::demos
