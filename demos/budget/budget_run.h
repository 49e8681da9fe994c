#pragma once
// Measures a scene: the loop of `render` on one thread (step, draw, read back, encode, with no file written),
// run from the beginning as often as asked. Tested in tests/demos/report/budget_work_test.cpp.

#include <functional>
#include <memory>

#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_cost.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

struct ReplayPlan {
  const Scene& scene;
  const std::optional<std::filesystem::path>& mesh;
  const FrameClock& clock;
  const CameraPath& camera;
  int frames = 0;
  int replays = 0;
  int threads = 1;                  ///< That step.
  bool keeps_slices = false;        ///< Of the quickest replay.
  std::function<double()> clock_s;  ///< What times are told by: `steadySeconds` or `processSeconds`.
};

/// One replay, frame by frame. Draws once before the clock starts, for shaders are compiled on first use. The
/// plan and the renderer must outlive this.
class FrameLoop {
 public:
  FrameLoop(const ReplayPlan& plan, renderer::FrameRenderer& pictures);
  ~FrameLoop();
  FrameLoop(const FrameLoop&) = delete;
  FrameLoop& operator=(const FrameLoop&) = delete;

  /// Frames come in order, from 0. Throws Interrupted, SimulationInvalid.
  FrameCost next();
  std::vector<PhaseSlice> takeSlices();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Draws once before the clock starts, for shaders are compiled on first use. `done` is told how many frames
/// are finished. Throws Interrupted, SimulationInvalid.
std::vector<Replay> runReplays(const ReplayPlan& plan, renderer::FrameRenderer& pictures,
                               const std::function<void(int)>& done);

}  // namespace carom::demos
