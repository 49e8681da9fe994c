// `carom render`: the loop of the paper. The world steps to the next frame's time, the frame is drawn, and a
// second thread encodes it meanwhile.
#include "demos/command.h"

#include <cstdio>
#include <iostream>

#include "demos/build_info.h"
#include "demos/content_hash.h"
#include "demos/frame_clock.h"
#include "demos/frame_names.h"
#include "demos/frame_states.h"
#include "demos/frame_writer.h"
#include "demos/interrupt.h"
#include "demos/manifest.h"
#include "demos/nearest_name.h"
#include "demos/progress.h"
#include "demos/scene_world.h"
#include "demos/simulation_check.h"
#include "renderer/frame_renderer.h"

namespace carom::demos {
namespace {

struct NamedCamera {
  std::string name;
  renderer::Camera camera;
};

NamedCamera chosenCamera(const Scene& scene, const std::string& name) {
  const auto main = scene.cameras.find("main");
  auto chosen = main != scene.cameras.end() ? main : scene.cameras.begin();
  if (!name.empty()) chosen = scene.cameras.find(name);
  if (chosen != scene.cameras.end()) return {chosen->first, chosen->second};
  std::vector<std::string> names;
  for (const auto& [known, unused] : scene.cameras) names.push_back(known);
  throw UsageError("--camera " + name + ": no such camera in " + scene.file.string() +
                   acceptedNames(name, names));
}

Manifest emptyManifest(const RenderOptions& options, const Scene& scene, const NamedCamera& camera) {
  Manifest manifest;
  manifest.command = options.command_line;
  manifest.scene = scene.name;
  manifest.scene_hash = sceneHash(scene, options.choice.mesh);
  manifest.seed = scene.seed;
  manifest.width = options.width;
  manifest.height = options.height;
  manifest.fps = options.fps;
  manifest.steps_per_second = scene.rate_hz;
  manifest.camera = camera.name;
  return manifest;
}

/// The identity of a frame inside its own file.
renderer::PngText pngText(const Manifest& manifest, const FrameRecord& record) {
  char time[32];
  std::snprintf(time, sizeof time, "%.17g", record.time_s);
  return {{"Software", "carom " + programVersion()},
          {"Scene", manifest.scene + " " + hexText(manifest.scene_hash)},
          {"Frame", std::to_string(record.frame)},
          {"Time", time},
          {"State", hexText(record.state_hash)}};
}

/// Milliseconds since the last call.
class Stopwatch {
 public:
  double lap_ms() {
    const double now_s = steadySeconds();
    const double lap = 1000.0 * (now_s - last_s_);
    last_s_ = now_s;
    return lap;
  }

 private:
  double last_s_ = steadySeconds();
};

/// What the frames of one run share.
struct Run {
  const FrameClock& clock;
  const FrameNames& names;
  const renderer::Camera& camera;
  SceneWorld& scene;
  RunFacts& facts;
  Manifest& manifest;
};

void drawFrames(Run& run, renderer::FrameRenderer& pictures, FrameWriter& writer, Progress& progress) {
  FrameStates states(run.scene.world, run.clock, [&run](const World& world) {
    throwIfInterrupted();
    checkStep(world, world.audit(), run.scene.names, run.facts);
  });
  for (int frame = 0; frame < run.manifest.frames_planned; ++frame) {
    throwIfInterrupted();
    Stopwatch watch;
    FrameToWrite next;
    const std::vector<renderer::Instance> instances = drawnInstances(run.scene, states.advanceTo(frame));
    next.record.timings.physics_ms = watch.lap_ms();
    next.image = pictures.draw(instances, run.camera);
    next.record.timings.draw_ms = watch.lap_ms();
    next.path = run.names.file(frame);
    next.record.frame = frame;
    next.record.file = next.path.filename().string();
    next.record.time_s = run.clock.time(frame);
    next.record.step = run.scene.world.stepCount();
    next.record.state_hash = run.scene.world.stateHash();
    next.text = pngText(run.manifest, next.record);
    writer.submit(std::move(next));
    progress.done(frame + 1);
  }
}

void tellStart(const Run& run, const Scene& scene) {
  std::cerr << scene.name << ": " << run.scene.names.size() << " bodies, " << run.manifest.frames_planned
            << " frames at " << run.manifest.fps << " fps, " << scene.rate_hz << " steps/s, camera "
            << run.manifest.camera << ", seed " << scene.seed << ", scene hash "
            << hexText(run.manifest.scene_hash) << '\n'
            << "GL: " << run.manifest.gl.renderer << ", " << run.manifest.gl.version << '\n';
}

void printReport(const Run& run) {
  const Manifest& m = run.manifest;
  const FrameTimings total = totalTimings(m.frames);
  const double count = static_cast<double>(m.frames.size());
  char line[256];
  std::snprintf(line, sizeof line,
                "%zu frames  %.2f s  %.1f fps end to end  physics %.2f ms  draw %.2f ms  encode %.2f ms  "
                "smallest gap %.3g m",
                m.frames.size(), m.wall_s, count / m.wall_s, total.physics_ms / count, total.draw_ms / count,
                total.encode_ms / count, run.facts.smallest_gap_m);
  std::cout << run.names.pattern() << "  " << line << '\n';
}

void noteOlderFrames(const FrameNames& names, int count) {
  std::error_code ignored;
  if (std::filesystem::exists(names.file(count), ignored))
    std::cerr << "note: " << names.file(count).string()
              << " and what follows it are from an earlier, longer run\n";
}

}  // namespace

ExitCode render(const RenderOptions& options) {
  const double started_s = steadySeconds();
  const Scene scene = chosenScene(options.choice);
  const NamedCamera camera = chosenCamera(scene, options.camera);
  const FrameNames names(options.output.empty() ? "frames/" + scene.name + "/frame_%04d.png"
                                                : options.output);
  const FrameClock clock({options.fps, scene.rate_hz});
  Manifest manifest = emptyManifest(options, scene, camera);
  manifest.frames_planned = clock.frameCount(scene.duration_s);
  if (manifest.frames_planned < 1)
    throw UsageError("the duration of " + std::to_string(scene.duration_s) + " s holds no frame at " +
                     std::to_string(options.fps) + " fps");

  SceneWorld made = makeSceneWorld(scene, options.choice.mesh);
  renderer::FrameRenderer pictures({options.width, options.height}, made.world.solids());
  manifest.gl = pictures.info();
  RunFacts facts;
  Run run{clock, names, camera.camera, made, facts, manifest};
  if (options.telling.verbose) tellStart(run, scene);

  catchInterrupts();
  // A run that ends early still finishes the frames it has drawn and says which they are.
  FrameWriter writer;
  std::exception_ptr ended_early;
  try {
    const ProgressStyle style =
        options.telling.quiet ? ProgressStyle::kNone : progressStyle(options.telling.progress);
    Progress progress({"frame", manifest.frames_planned}, style, std::cerr, steadySeconds);
    drawFrames(run, pictures, writer, progress);
  } catch (const std::exception&) {
    ended_early = std::current_exception();
  }
  manifest.frames = writer.finish();
  manifest.wall_s = steadySeconds() - started_s;
  writeManifest(manifest, names.folder() / "manifest.json");
  if (ended_early) std::rethrow_exception(ended_early);
  if (!options.telling.quiet) noteOlderFrames(names, manifest.frames_planned);
  printReport(run);
  return ExitCode::kOk;
}

}  // namespace carom::demos
