#pragma once
// manifest.json: what a folder of frames is and what each frame cost, so that frames can be told apart,
// checked and timed later. Written beside the frames, also for a run that was interrupted. Tested in
// tests/demos/frames/manifest_test.cpp.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {

/// Milliseconds that one frame took in each phase; encode covers compressing, hashing and writing.
struct FrameTimings {
  double physics_ms = 0.0;
  double draw_ms = 0.0;
  double encode_ms = 0.0;
};

/// A frame's other output, such as its depth.
struct OutputRecord {
  std::string name;
  std::string file;              ///< Name within the folder.
  std::uint64_t pixel_hash = 0;  ///< ContentHash of the 16-bit samples.
};

struct FrameRecord {
  int frame = 0;
  std::string file;  ///< Name within the folder.
  double time_s = 0.0;
  int step = 0;                  ///< Steps the world had made.
  std::uint64_t state_hash = 0;  ///< Of the world after those steps.
  std::uint64_t pixel_hash = 0;  ///< ContentHash of the image's RGB bytes.
  FrameTimings timings;
  std::vector<OutputRecord> outputs;
  bool kept = false;  ///< An earlier run had drawn it (--resume).
};

struct Manifest {
  std::string command;
  std::string scene;
  std::uint64_t scene_hash = 0;
  std::uint64_t seed = 0;
  int width = 0;
  int height = 0;
  double fps = 0.0;
  double speed = 1.0;  ///< Seconds of the scene a second of frames.
  double steps_per_second = 0.0;
  std::string camera;
  renderer::Preset preset = renderer::Preset::kRealtime;
  renderer::Style style = renderer::Style::kDaylight;
  std::string light;  ///< Empty: the usual one.
  double shutter_degrees = 0.0;
  bool cutout = false;   ///< The pictures have alpha in place of a background.
  Json meshes;           ///< What was made of mesh files; null: there are none.
  Json outputs;          ///< What the numbers of other outputs mean (frame_outputs.h); null: there are none.
  std::string overlays;  ///< Names and focus; empty: none.
  bool has_caption = false;
  bool portable = false;  ///< The same pixels on every CPU.
  renderer::ContextInfo gl;
  int frames_planned = 0;
  double wall_s = 0.0;
  std::vector<FrameRecord> frames;
};

/// Throws CannotWrite.
void writeManifest(const Manifest& manifest, const std::filesystem::path& path);

/// The sums over the frames so far.
FrameTimings totalTimings(const std::vector<FrameRecord>& frames);

}  // namespace carom::demos
