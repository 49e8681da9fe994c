#pragma once
// One frame of a run: the world steps to its time, it is drawn unless an earlier run has, and it is ready to
// be encoded. Tested in tests/demos/program/program_test.cpp.

#include <vector>

#include "demos/format/progress.h"
#include "demos/frames/frame_writer.h"
#include "demos/motion/frame_source.h"
#include "demos/overlay/overlays.h"
#include "demos/record/motion_recorder.h"
#include "demos/render/frame_workers.h"
#include "demos/render/render_plan.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/scene_caption.h"
#include "demos/scene/scene_world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

/// What the frames of one run share.
struct RenderRun {
  const RenderPlan& plan;
  const FrameNames* names;  ///< None: the frames get no files.
  bool resume = false;
  const SceneWorld& scene;
  FrameSource& source;
  const CameraPath& camera;
  const SceneCaption* caption;  ///< None: no line is drawn.
  const OutputScale& scale;
  Overlays& overlays;
  Manifest& manifest;
  MotionRecorder* recorder;       ///< None: the frames get no record.
  std::vector<FrameRecord> kept;  ///< Frames that an earlier run had drawn.
};

/// Steps the world to a frame. Throws Interrupted.
FrameJob nextJob(RenderRun& run, int frame);

/// The frame without its pixels.
FrameToWrite plannedFrame(const RenderRun& run, const FrameJob& job);

/// Whether an earlier run has drawn it: then its record says so.
bool keepFrame(const RenderRun& run, FrameToWrite& frame);

/// Tells the recorder, if there is one, of the frame that comes next.
void recordShot(const RenderRun& run, const FrameJob& job, const FrameToWrite& next);

/// Tells it what is behind the pixels of a frame that is kept: as it was recorded, or else looked at afresh.
void recordKept(const RenderRun& run, renderer::FrameRenderer& pictures, const FrameJob& job);

void drawFrame(const RenderRun& run, renderer::FrameRenderer& pictures, const FrameJob& job,
               FrameToWrite& next);

}  // namespace carom::demos
