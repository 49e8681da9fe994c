#pragma once
// Measures a scene: the loop of `render` on one thread (step, draw, read back, encode, with no file written),
// run from the beginning as often as asked. Tested in tests/demos/budget_program_test.cpp.

#include <functional>

#include "demos/camera_path.h"
#include "demos/frame_clock.h"
#include "demos/frame_cost.h"
#include "demos/scene_world.h"

namespace carom::demos {

struct ReplayPlan {
  const Scene& scene;
  const std::optional<std::filesystem::path>& mesh;
  const FrameClock& clock;
  const CameraPath& camera;
  int frames = 0;
  int replays = 0;
  int threads = 1;            ///< That step.
  bool keeps_slices = false;  ///< Of the quickest replay.
};

/// Draws once before the clock starts, for shaders are compiled on first use. `done` is told how many frames
/// are finished. Throws Interrupted, SimulationInvalid.
std::vector<Replay> runReplays(const ReplayPlan& plan, renderer::FrameRenderer& pictures,
                               const std::function<void(int)>& done);

}  // namespace carom::demos
