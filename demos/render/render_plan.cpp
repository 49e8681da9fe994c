#include "demos/render/render_plan.h"

#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/frames/frame_identity.h"
#include "demos/frames/frame_selection.h"
#include "demos/frames/frame_stream.h"
#include "demos/language/scene_values.h"
#include "demos/record/recorded_scene.h"
#include "demos/scene/scene_world.h"
#include "demos/video/contact_sheet.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr int kMostFrames = 10000000;

Shutter chosenShutter(const RenderOptions& options) {
  const renderer::Preset preset = renderer::presetOf(options.preset);
  const int exposures = renderer::qualityOf(preset, renderer::styleOf(options.style)).samples;
  const Shutter shutter(options.shutter_degrees, exposures);
  if (options.shutter_degrees == 0.0) return shutter;
  const auto refuse = [](const std::string& with, const char* accepted) {
    throw UsageError("--shutter with " + with + ": accepted: " + accepted);
  };
  if (!shutter.isOpen()) refuse("--preset " + options.preset, "--preset quality or cinematic");
  if (!options.from.empty())
    refuse("--from", "the scene itself, for a recording has no motion between frames");
  if (!options.overlays.empty()) refuse("--overlay", "one of them");
  if (options.at_s) refuse("--at", "--frames with one number");
  return shutter;
}

[[noreturn]] void refuseNoFrame(const RenderPlan& plan, double speed) {
  std::string line =
      formatted("the duration of %.9g s holds no frame at %.9g fps", plan.scene.duration_s, plan.fps);
  if (speed != 1.0)
    line += formatted(", of which each takes %.3g s of it with --speed %.9g", speed / plan.fps, speed);
  throw UsageError(line);
}

}  // namespace

RenderPlan planned(const RenderOptions& options, const std::optional<RecordingReader>& recording) {
  SceneChoice choice = options.choice;
  if (recording) choice = recordedChoice({options.from, recording->header()}, choice, "render SCENE --from");
  const Scene scene = chosenScene(choice);
  const double scene_fps = recording ? recording->header().fps : options.fps / options.speed;
  if (scene.duration_s * scene_fps > kMostFrames)
    throw UsageError("the duration of " + plainNumber(scene.duration_s) + " s holds more than " +
                     std::to_string(kMostFrames) + " frames");
  const FrameClock clock =
      options.at_s ? FrameClock::still(*options.at_s, scene.rate_hz) : FrameClock({scene_fps, scene.rate_hz});
  RenderPlan plan{.choice = choice,
                  .scene = scene,
                  .camera = chosenCamera(scene, options.camera),
                  .preset = renderer::presetOf(options.preset),
                  .style = renderer::styleOf(options.style),
                  .light = chosenLight(scene.light, options.light, options.exposure),
                  .cutout = options.background == "none",
                  .shutter = chosenShutter(options),
                  .outputs = readOutputs(options.aov),
                  .clock = clock,
                  .fps = recording ? scene_fps * options.speed : options.fps,
                  .frame_count = clock.frameCount(scene.duration_s),
                  .frames = {}};
  if (recording) {
    requireSameScene({options.from, recording->header()}, plan.scene, plan.choice);
    plan.frame_count = recording->header().frames;
  }
  if (plan.frame_count < 1) refuseNoFrame(plan, options.speed);
  plan.frames = options.sheet.empty()
                    ? shardOf(selectedFrames(options.frames, plan.frame_count), readShard(options.shard))
                    : sheetFrames(readSheet(options.sheet), plan.frame_count);
  return plan;
}

Manifest emptyManifest(const RenderOptions& options, const RenderPlan& plan) {
  Manifest manifest;
  manifest.command = options.command_line;
  manifest.scene = plan.scene.name;
  manifest.scene_hash = sceneHash(plan.scene, plan.choice.mesh);
  manifest.seed = plan.scene.seed;
  manifest.width = options.width;
  manifest.height = options.height;
  manifest.fps = plan.fps;
  manifest.speed = options.speed;
  manifest.steps_per_second = plan.scene.rate_hz;
  manifest.camera = plan.camera.name;
  manifest.preset = plan.preset;
  manifest.style = plan.style;
  manifest.light = lightText(plan.light);
  manifest.cutout = plan.cutout;
  manifest.portable = options.portable;
  manifest.shutter_degrees = options.shutter_degrees;
  manifest.frames_planned = static_cast<int>(plan.frames.size());
  return manifest;
}

/// A stream holds one picture a frame: the colours, or one other output in their place.
void requireStreamable(const RenderOptions& options, const std::vector<FrameOutput>& outputs) {
  if (outputs.size() > 1)
    throw UsageError("--aov " + options.aov + ": accepted with --stream: one of depth, normal and id");
  if (!outputs.empty() && streamFormat(options.stream) == StreamFormat::kRgb24)
    throw UsageError("--stream rgb24 has 8 bits a sample; accepted with --aov: png or ppm");
}

/// Streams of bare colours, moving pictures and sheets have no alpha, and overlays are drawn over a whole
/// picture.
void requireAlpha(const RenderOptions& options, const OverlayChoice& shown) {
  const auto refuse = [](const std::string& with, const char* accepted) {
    throw UsageError("--background none with " + with + ": accepted: " + accepted);
  };
  if (options.style != "daylight") refuse("--style " + options.style, "--style daylight");
  if (shown.any()) refuse("--overlay", "none");
  if (options.caption) refuse("--caption on", "--caption off");
  if (!options.sheet.empty()) refuse("--sheet", "PNG frames");
  if (!options.moving.empty()) refuse(options.moving.string(), "PNG frames");
  if (!options.stream.empty() && options.stream != "png")
    refuse("--stream " + options.stream, "--stream png");
}

std::optional<FrameNames> frameNames(const RenderOptions& options, const std::string& scene) {
  if (!options.stream.empty() || !options.moving.empty() || !options.sheet.empty()) return std::nullopt;
  const std::string& output = options.output;
  if (options.at_s) return FrameNames::still(output.empty() ? "frames/" + scene + "/still.png" : output);
  return FrameNames(output.empty() ? "frames/" + scene + "/frame_%04d.png" : output);
}

std::string manifestNameOf(const RenderOptions& options, const FrameNames& names) {
  if (options.at_s) return names.file(0).stem().string() + ".manifest.json";
  return manifestName(options.frames, options.shard);
}

FolderClaim::Claim folderClaim(const RenderOptions& options, const Manifest& manifest,
                               const FrameNames& names) {
  ContentHash identity;
  for (const auto& [key, value] : frameText(manifest, {})) identity.add(key).add(value);
  for (const int number : {options.width, options.height}) identity.add(std::to_string(number));
  for (const double number :
       {manifest.fps, manifest.speed, manifest.steps_per_second, options.at_s.value_or(0.0)})
    identity.add(&number, sizeof number);
  const std::string name = std::filesystem::path(names.pattern()).filename().string();
  return {names.folder(), options.at_s ? "still " + name : "frames", identity.add(name).value()};
}

}  // namespace carom::demos
