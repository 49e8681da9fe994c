#pragma once
// Where the states of a run's frames come from: the world, stepped and checked, or a recording of it. Tested
// in tests/demos/frame_source_test.cpp.

#include <functional>
#include <optional>

#include "demos/frame_clock.h"
#include "demos/frame_states.h"
#include "demos/recording.h"
#include "demos/scene_world.h"
#include "demos/simulation_check.h"

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
