#include "demos/manifest.h"

#include <cmath>

#include "demos/atomic_file.h"
#include "demos/build_info.h"
#include "demos/content_hash.h"
#include "demos/json.h"

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
  return Json::object({{"frame", record.frame},
                       {"file", record.file},
                       {"time_s", record.time_s},
                       {"step", record.step},
                       {"stateHash", hexText(record.state_hash)},
                       {"pixelHash", hexText(record.pixel_hash)},
                       {"kept", record.kept},
                       {"ms", timingsJson(record.timings)}});
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
  const Json json = Json::object(
      {{"format", 1},
       {"command", manifest.command},
       {"complete", complete},
       {"scene", manifest.scene},
       {"sceneHash", hexText(manifest.scene_hash)},
       {"seed", static_cast<double>(manifest.seed)},
       {"size", Json::array({manifest.width, manifest.height})},
       {"fps", manifest.fps},
       {"stepsPerSecond", manifest.steps_per_second},
       {"camera", manifest.camera},
       {"version", programVersion()},
       {"build", buildName()},
       {"gl", Json::object({{"renderer", manifest.gl.renderer}, {"version", manifest.gl.version}})},
       {"cpu", cpuClass()},
       {"framesPlanned", manifest.frames_planned},
       {"wall_s", roundedToMicroseconds(manifest.wall_s)},
       {"total_ms", timingsJson(totalTimings(manifest.frames))},
       {"frames", std::move(frames)}});
  AtomicFile file(path);
  file.write(json.text(1) + "\n");
  file.commit();
}

}  // namespace carom::demos
