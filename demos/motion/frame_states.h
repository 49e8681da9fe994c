#pragma once
// Steps a world to the instant of each frame in turn and gives the bodies' states there. A frame between two
// steps shows the bodies on the paths that the world has proven to be apart; the world never steps for a
// picture's sake. Tested in tests/demos/motion/frame_states_test.cpp.

#include <functional>
#include <span>
#include <vector>

#include "demos/motion/frame_clock.h"
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

  /// Steps on to the end of `step`; frames before that cannot be asked for any more.
  void stepTo(int step);

 private:
  World& world_;
  const FrameClock& clock_;
  AfterStep after_step_;
  PhaseClock* phases_;
  std::vector<BodyState> shown_;  // between two steps
};

}  // namespace carom::demos
