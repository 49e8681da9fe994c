#pragma once
// Where the states of a run's frames come from: the world, stepped and checked, or a recording of it. Tested
// in tests/demos/motion/frame_source_test.cpp.

#include <functional>
#include <optional>

#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_states.h"
#include "demos/motion/simulation_check.h"
#include "demos/record/recording.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

class FrameSource {
 public:
  using AfterStep = std::function<void(const World&)>;

  /// Steps the world of `scene`, telling `phases` and, after every step, `watcher`; all must outlive this.
  FrameSource(SceneWorld& scene, const FrameClock& clock, RunFacts& facts, PhaseClock* phases = nullptr,
              AfterStep watcher = {});
  explicit FrameSource(RecordingReader& recording) : recording_(&recording) {}
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// The state at a frame, which is not before the last one asked for; valid until the next call. Throws
  /// Interrupted, and SimulationInvalid as `checkStep`.
  FrameState at(int frame);

 private:
  SceneWorld* scene_ = nullptr;
  std::optional<FrameStates> states_;
  RecordingReader* recording_ = nullptr;
};

}  // namespace carom::demos
