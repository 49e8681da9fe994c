#pragma once
// Steps a world to the instant of each frame in turn and gives the bodies' states there. The step before is
// kept, so that a frame between two steps is interpolated and the world never steps for a picture's sake.
// Tested in tests/demos/frame_states_test.cpp.

#include <functional>
#include <span>
#include <vector>

#include "demos/frame_clock.h"
#include "engine/simulation/world.h"

namespace carom::demos {

class FrameStates {
 public:
  using AfterStep = std::function<void(const World&)>;

  /// All must outlive this. `after_step` is called after every step; `phases` is told of the steps' phases.
  FrameStates(World& world, const FrameClock& clock, AfterStep after_step, PhaseClock* phases = nullptr);

  /// Steps on to `frame`, which must not be before the last one asked for; the states at its exact time,
  /// valid until the next call.
  std::span<const BodyState> advanceTo(int frame);

  /// Steps on to the end of `step`.
  void stepTo(int step);

 private:
  World& world_;
  const FrameClock& clock_;
  AfterStep after_step_;
  PhaseClock* phases_;
  std::vector<BodyState> before_;  // states one step before the world's
  std::vector<BodyState> shown_;
};

}  // namespace carom::demos
