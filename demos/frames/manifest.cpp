#include "demos/frames/manifest.h"

#include <cmath>

#include "demos/format/content_hash.h"
#include "demos/format/json.h"
#include "demos/system/atomic_file.h"
#include "demos/system/build_info.h"

namespace carom::demos {
namespace {

/// Timings are noise below a microsecond.
double roundedToMicroseconds(double ms) {
  return std::round(ms * 1000.0) / 1000.0;
}

Json timingsJson(const FrameTimings& timings) {
  return Json::object({{"physics", roundedToMicroseconds(timings.physics_ms)},
                       {"draw", roundedToMicroseconds(timings.draw_ms)},
                       {"encode", roundedToMicroseconds(timings.encode_ms)}});
}

Json frameJson(const FrameRecord& record) {
  Json json = Json::object({{"frame", record.frame},
                            {"file", record.file},
                            {"time_s", record.time_s},
                            {"step", record.step},
                            {"stateHash", hexText(record.state_hash)},
                            {"pixelHash", hexText(record.pixel_hash)},
                            {"kept", record.kept},
                            {"ms", timingsJson(record.timings)}});
  if (record.outputs.empty()) return json;
  Json outputs = Json::object();
  for (const OutputRecord& output : record.outputs)
    outputs.set(output.name,
                Json::object({{"file", output.file}, {"pixelHash", hexText(output.pixel_hash)}}));
  json.set("outputs", std::move(outputs));
  return json;
}

/// What a run without these options has not.
void addUnusual(const Manifest& manifest, Json& json) {
  if (manifest.speed != 1.0) json.set("speed", manifest.speed);
  if (manifest.preset != renderer::Preset::kRealtime) json.set("preset", nameOf(manifest.preset));
  if (manifest.style != renderer::Style::kDaylight) json.set("style", nameOf(manifest.style));
  if (!manifest.light.empty()) json.set("light", manifest.light);
  if (manifest.shutter_degrees > 0.0) json.set("shutterDegrees", manifest.shutter_degrees);
  if (manifest.cutout) json.set("background", "none");
  if (!manifest.overlays.empty()) json.set("overlays", manifest.overlays);
  if (manifest.has_caption) json.set("caption", true);
  if (manifest.outputs.kind() != Json::Kind::kNull) json.set("outputs", manifest.outputs);
}

}  // namespace

FrameTimings totalTimings(const std::vector<FrameRecord>& frames) {
  FrameTimings total;
  for (const FrameRecord& record : frames) {
    total.physics_ms += record.timings.physics_ms;
    total.draw_ms += record.timings.draw_ms;
    total.encode_ms += record.timings.encode_ms;
  }
  return total;
}

void writeManifest(const Manifest& manifest, const std::filesystem::path& path) {
  Json frames = Json::array();
  for (const FrameRecord& record : manifest.frames) frames.push(frameJson(record));
  const bool complete = static_cast<int>(manifest.frames.size()) == manifest.frames_planned;
  Json json = Json::object({{"format", 1},
                            {"command", manifest.command},
                            {"complete", complete},
                            {"scene", manifest.scene},
                            {"sceneHash", hexText(manifest.scene_hash)},
                            {"seed", static_cast<double>(manifest.seed)},
                            {"size", Json::array({manifest.width, manifest.height})},
                            {"fps", manifest.fps},
                            {"stepsPerSecond", manifest.steps_per_second},
                            {"camera", manifest.camera}});
  addUnusual(manifest, json);
  if (manifest.meshes.kind() != Json::Kind::kNull) json.set("meshes", manifest.meshes);
  json.set("version", programVersion());
  json.set("build", buildName());
  json.set("gl", Json::object({{"renderer", manifest.gl.renderer},
                               {"version", manifest.gl.version},
                               {"context", renderer::nameOf(manifest.gl.backend)},
                               {"reason", manifest.gl.reason}}));
  json.set("cpu", cpuClass());
  json.set("framesPlanned", manifest.frames_planned);
  json.set("wall_s", roundedToMicroseconds(manifest.wall_s));
  json.set("total_ms", timingsJson(totalTimings(manifest.frames)));
  json.set("frames", std::move(frames));
  AtomicFile file(path);
  file.write(json.text(1) + "\n");
  file.commit();
}

}  // namespace carom::demos
