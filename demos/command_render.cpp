// `carom render`: the loop of the paper. The world steps to the next frame's time, the frame is drawn, and a
// second thread encodes it meanwhile. Long jobs draw a part of the frames, keep those that are up to date, or
// take the motion from a recording; a frame's bytes are the same on every one of these ways.
#include "demos/command.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>
#include <sstream>

#include <unistd.h>

#include "demos/atomic_file.h"
#include "demos/content_hash.h"
#include "demos/ffmpeg_video.h"
#include "demos/frame_clock.h"
#include "demos/frame_identity.h"
#include "demos/frame_names.h"
#include "demos/frame_selection.h"
#include "demos/frame_source.h"
#include "demos/frame_stream.h"
#include "demos/frame_writer.h"
#include "demos/interrupt.h"
#include "demos/manifest.h"
#include "demos/pipe_writer.h"
#include "demos/progress.h"
#include "demos/recorded_scene.h"
#include "demos/recording.h"
#include "demos/scene_world.h"
#include "engine/foundation/contract.h"
#include "renderer/frame_renderer.h"

namespace carom::demos {
namespace {

/// What is to be drawn, settled before anything is made.
struct Plan {
  SceneChoice choice;
  Scene scene;
  NamedCamera camera;
  FrameClock clock;
  int frame_count = 0;      ///< Of the whole run.
  std::vector<int> frames;  ///< Those chosen.
};

Plan planned(const RenderOptions& options, const std::optional<RecordingReader>& recording) {
  SceneChoice choice = options.choice;
  if (recording) choice = recordedChoice({options.from, recording->header()}, choice, "render SCENE --from");
  const Scene scene = chosenScene(choice);
  const double fps = recording ? recording->header().fps : options.fps;
  const FrameClock clock({fps, scene.rate_hz});
  Plan plan{choice, scene, chosenCamera(scene, options.camera), clock, clock.frameCount(scene.duration_s),
            {}};
  if (recording) {
    requireSameScene({options.from, recording->header()}, plan.scene, plan.choice);
    plan.frame_count = recording->header().frames;
  }
  if (plan.frame_count < 1)
    throw UsageError("the duration of " + std::to_string(scene.duration_s) + " s holds no frame at " +
                     std::to_string(fps) + " fps");
  plan.frames = shardOf(selectedFrames(options.frames, plan.frame_count), readShard(options.shard));
  return plan;
}

Manifest emptyManifest(const RenderOptions& options, const Plan& plan) {
  Manifest manifest;
  manifest.command = options.command_line;
  manifest.scene = plan.scene.name;
  manifest.scene_hash = sceneHash(plan.scene, plan.choice.mesh);
  manifest.seed = plan.scene.seed;
  manifest.width = options.width;
  manifest.height = options.height;
  manifest.fps = plan.clock.fps();
  manifest.steps_per_second = plan.scene.rate_hz;
  manifest.camera = plan.camera.name;
  manifest.frames_planned = static_cast<int>(plan.frames.size());
  return manifest;
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
  const Plan& plan;
  const FrameNames* names;  ///< None: the frames get no files.
  bool resume = false;
  const SceneWorld& scene;
  FrameSource& source;
  Manifest& manifest;
  std::vector<FrameRecord> kept;  ///< Frames that an earlier run had drawn.
};

bool keepFrame(Run& run, FrameToWrite& frame) {
  if (!run.resume) return false;
  const std::optional<std::uint64_t> pixels =
      wantedFrame(frame.path, frame.text, {run.manifest.width, run.manifest.height});
  if (!pixels) return false;
  frame.record.pixel_hash = *pixels;
  frame.record.kept = true;
  run.kept.push_back(frame.record);
  return true;
}

void drawFrames(Run& run, renderer::FrameRenderer& pictures, FrameWriter& writer, Progress& progress) {
  int done = 0;
  for (const int frame : run.plan.frames) {
    throwIfInterrupted();
    Stopwatch watch;
    FrameToWrite next;
    const FrameState state = run.source.at(frame);
    next.record.timings.physics_ms = watch.lap_ms();
    if (run.names != nullptr) next.path = run.names->file(frame);
    next.record.frame = frame;
    next.record.file = next.path.filename().string();
    next.record.time_s = run.plan.clock.time(frame);
    next.record.step = state.step;
    next.record.state_hash = state.state_hash;
    next.text = frameText(run.manifest, next.record);
    if (!keepFrame(run, next)) {
      watch.lap_ms();
      next.image = pictures.draw(drawnInstances(run.scene, state.bodies), run.plan.camera.camera);
      next.record.timings.draw_ms = watch.lap_ms();
      writer.submit(std::move(next));
    }
    progress.done(++done);
  }
}

void tellStart(const Run& run) {
  const Scene& scene = run.plan.scene;
  std::cerr << scene.name << ": " << run.scene.names.size() << " bodies, " << run.manifest.frames_planned
            << " frames at " << run.manifest.fps << " fps, " << scene.rate_hz << " steps/s, camera "
            << run.manifest.camera << ", seed " << scene.seed << ", scene hash "
            << hexText(run.manifest.scene_hash) << '\n'
            << "GL: " << run.manifest.gl.renderer << ", " << run.manifest.gl.version << '\n';
}

/// "12 frames  0.41 s  29.3 fps end to end", of a run whose frames went through a pipe.
std::string pipedReport(const Run& run) {
  char line[96];
  const double count = run.manifest.frames_planned;
  std::snprintf(line, sizeof line, "%d frames  %.2f s  %.1f fps end to end", run.manifest.frames_planned,
                run.manifest.wall_s, count / run.manifest.wall_s);
  return line;
}

std::string filesReport(const Run& run, const RunFacts& facts) {
  const Manifest& m = run.manifest;
  const FrameTimings total = totalTimings(m.frames);
  const double count = std::max<double>(1.0, static_cast<double>(m.frames.size()));
  const double drawn = std::max<double>(1.0, static_cast<double>(m.frames.size() - run.kept.size()));
  char line[256];
  std::snprintf(line, sizeof line,
                "%zu frames  %.2f s  %.1f fps end to end  physics %.2f ms  draw %.2f ms  encode %.2f ms",
                m.frames.size(), m.wall_s, count / m.wall_s, total.physics_ms / count, total.draw_ms / drawn,
                total.encode_ms / drawn);
  std::ostringstream report;
  report.precision(3);
  report << run.names->pattern() << "  " << line;
  if (facts.smallest_gap_m < std::numeric_limits<double>::infinity())
    report << "  smallest gap " << facts.smallest_gap_m << " m";
  if (run.resume)
    report << "  (" << m.frames.size() - run.kept.size() << " drawn, " << run.kept.size() << " kept)";
  return report.str();
}

void noteOlderFrames(const FrameNames& names, int count) {
  std::error_code ignored;
  if (std::filesystem::exists(names.file(count), ignored))
    std::cerr << "note: " << names.file(count).string()
              << " and what follows it are from an earlier, longer run\n";
}

/// What an earlier run that was killed left of the files that this one is to write, and of nobody else's.
void removeLeftOvers(const Run& run, const std::string& manifest_name) {
  std::set<std::string> names{manifest_name};
  for (const int frame : run.plan.frames) names.insert(run.names->file(frame).filename().string());
  removeAbandoned(run.names->folder(), names);
}

/// Draws what is planned; a run that ends early still finishes the frames it has drawn and tells which they
/// are in its manifest.
void drawPlanned(Run& run, renderer::FrameRenderer& pictures, const FrameWriter::Write& write,
                 const Telling& telling, const std::filesystem::path& manifest_file, double started_s) {
  FrameWriter writer(write);
  std::exception_ptr ended_early;
  try {
    const ProgressStyle style = telling.quiet ? ProgressStyle::kNone : progressStyle(telling.progress);
    Progress progress({"frame", run.manifest.frames_planned}, style, std::cerr, steadySeconds);
    drawFrames(run, pictures, writer, progress);
  } catch (const std::exception&) {
    ended_early = std::current_exception();
  }
  std::vector<FrameRecord>& frames = run.manifest.frames;
  frames = writer.finish();
  frames.insert(frames.end(), run.kept.begin(), run.kept.end());
  std::sort(frames.begin(), frames.end(),
            [](const FrameRecord& a, const FrameRecord& b) { return a.frame < b.frame; });
  run.manifest.wall_s = steadySeconds() - started_s;
  if (run.names != nullptr) writeManifest(run.manifest, manifest_file);
  if (ended_early) std::rethrow_exception(ended_early);
}

void renderFiles(Run& run, renderer::FrameRenderer& pictures, const RenderOptions& options,
                 const RunFacts& facts, double started_s) {
  const std::string manifest_name = manifestName(options.frames, options.shard);
  if (run.resume) removeLeftOvers(run, manifest_name);
  drawPlanned(run, pictures, writeFrameFile, options.telling, run.names->folder() / manifest_name, started_s);
  if (!options.telling.quiet) noteOlderFrames(*run.names, run.plan.frame_count);
  std::cout << filesReport(run, facts) << '\n';
}

void renderStream(Run& run, renderer::FrameRenderer& pictures, const RenderOptions& options,
                  double started_s) {
  const StreamFormat format = streamFormat(options.stream);
  PipeWriter out(STDOUT_FILENO, "standard output");
  const auto write = [&](const FrameToWrite& frame) -> std::optional<FrameRecord> {
    out.write(streamedFrame(format, frame));
    return std::nullopt;
  };
  drawPlanned(run, pictures, write, options.telling, {}, started_s);
  if (!options.telling.quiet) std::cerr << pipedReport(run) << '\n';
}

void renderVideo(Run& run, renderer::FrameRenderer& pictures, const RenderOptions& options,
                 double started_s) {
  FfmpegVideo video(options.ffmpeg, {options.width, options.height, run.manifest.fps});
  const auto write = [&](const FrameToWrite& frame) -> std::optional<FrameRecord> {
    video.write(frame.image.rgb);
    return std::nullopt;
  };
  drawPlanned(run, pictures, write, options.telling, {}, started_s);
  video.commit();
  std::cout << options.ffmpeg.string() << "  " << pipedReport(run) << '\n';
}

}  // namespace

ExitCode render(const RenderOptions& options) {
  const double started_s = steadySeconds();
  if (!options.stream.empty()) streamFormat(options.stream);
  if (!options.stream.empty() && ::isatty(STDOUT_FILENO) != 0)
    throw UsageError("-o -: standard output is a terminal; accepted: a pipe or a file");
  std::optional<RecordingReader> recording;
  if (!options.from.empty()) recording.emplace(options.from);
  const Plan plan = planned(options, recording);
  std::optional<FrameNames> names;
  if (options.stream.empty() && options.ffmpeg.empty())
    names.emplace(options.output.empty() ? "frames/" + plan.scene.name + "/frame_%04d.png" : options.output);
  Manifest manifest = emptyManifest(options, plan);

  SceneWorld made = makeSceneWorld(plan.scene, plan.choice.mesh);
  renderer::Settings settings{options.width, options.height};
  if (options.portable) settings.pixels = renderer::PixelPolicy::kPortable;
  renderer::FrameRenderer pictures(settings, made.world.solids());
  manifest.gl = pictures.info();
  RunFacts facts;
  std::optional<FrameSource> source;
  if (recording)
    source.emplace(*recording);
  else
    source.emplace(made, plan.clock, facts);
  Run run{plan, names ? &*names : nullptr, options.resume, made, *source, manifest, {}};
  if (options.telling.verbose) tellStart(run);

  catchInterrupts();
  if (run.names != nullptr)
    renderFiles(run, pictures, options, facts, started_s);
  else if (!options.stream.empty())
    renderStream(run, pictures, options, started_s);
  else
    renderVideo(run, pictures, options, started_s);
  return ExitCode::kOk;
}

}  // namespace carom::demos
