#pragma once
// What `render` is to draw, settled from the options before anything is made: the scene, the moments, the
// look, and the files. Tested in tests/demos/program/program_test.cpp and
// tests/demos/render/long_jobs_test.cpp.

#include <optional>
#include <string>
#include <vector>

#include "demos/frames/folder_claim.h"
#include "demos/frames/frame_names.h"
#include "demos/frames/frame_outputs.h"
#include "demos/frames/manifest.h"
#include "demos/motion/frame_clock.h"
#include "demos/overlay/overlay_choice.h"
#include "demos/record/recording.h"
#include "demos/render/render_job.h"
#include "demos/render/shutter.h"

namespace carom::demos {

struct RenderPlan {
  SceneChoice choice;
  Scene scene;
  NamedCamera camera;
  renderer::Preset preset = renderer::Preset::kRealtime;
  renderer::Style style = renderer::Style::kDaylight;
  SceneLight light;
  bool cutout = false;
  Shutter shutter{0.0, 1};
  std::vector<FrameOutput> outputs;
  FrameClock clock;
  double fps = 0.0;         ///< Of the frames as they are shown; the clock's are the scene's.
  int frame_count = 0;      ///< Of the whole run.
  std::vector<int> frames;  ///< Those chosen.
};

/// Throws UsageError for options that do not go together.
RenderPlan planned(const RenderOptions& options, const std::optional<RecordingReader>& recording);
void requireStreamable(const RenderOptions& options, const std::vector<FrameOutput>& outputs);
void requireAlpha(const RenderOptions& options, const OverlayChoice& shown);

/// All that is known before the first frame.
Manifest emptyManifest(const RenderOptions& options, const RenderPlan& plan);

/// None where the frames go into a stream, a moving picture or a sheet.
std::optional<FrameNames> frameNames(const RenderOptions& options, const std::string& scene);

/// Of a still it does not take the place of the manifest of frames in the same folder.
std::string manifestNameOf(const RenderOptions& options, const FrameNames& names);

/// What the bytes of the run's frames and their names depend on, but for the number of a frame. A folder has
/// one manifest and one kind of frames; a still is by itself.
FolderClaim::Claim folderClaim(const RenderOptions& options, const Manifest& manifest,
                               const FrameNames& names);

}  // namespace carom::demos
