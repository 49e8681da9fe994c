// `carom render`: the loop of the paper. The world steps to the next frame's time and the frame is drawn:
// here, while a second thread encodes the one before, or by worker processes that take the frames in turn.
// Long jobs draw a part of the frames, keep those that are up to date, or take the motion from a recording; a
// frame's bytes are the same on every one of these ways.
#include "demos/render/render_job.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>

#include <unistd.h>

#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"
#include "demos/format/progress.h"
#include "demos/frames/folder_claim.h"
#include "demos/frames/frame_names.h"
#include "demos/frames/frame_outputs.h"
#include "demos/frames/frame_stream.h"
#include "demos/frames/frame_writer.h"
#include "demos/frames/manifest.h"
#include "demos/frames/picture_settings.h"
#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_source.h"
#include "demos/overlay/overlays.h"
#include "demos/record/motion_recorder.h"
#include "demos/record/recording.h"
#include "demos/render/frame_drawing.h"
#include "demos/render/frame_workers.h"
#include "demos/render/render_plan.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/scene_caption.h"
#include "demos/scene/scene_world.h"
#include "demos/system/atomic_file.h"
#include "demos/system/build_info.h"
#include "demos/system/interrupt.h"
#include "demos/system/pipe_writer.h"
#include "demos/video/contact_sheet.h"
#include "demos/video/moving_picture.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {
namespace {

/// Where frames go: each is encoded, by whoever drew it, and then delivered in its turn.
struct Sink {
  std::function<DrawnFrame(FrameToWrite)> encode;
  std::function<void(std::span<const std::uint8_t>)> deliver;  ///< Null: encoding has written its files.
};

/// Who draws: workers, or this process itself.
struct Artists {
  std::optional<FrameWorkers>& workers;
  std::optional<renderer::FrameRenderer>& here;
};

void drawHere(RenderRun& run, renderer::FrameRenderer& pictures, FrameWriter& writer, Progress& progress) {
  int done = 0;
  for (const int frame : run.plan.frames) {
    const FrameJob job = nextJob(run, frame);
    FrameToWrite next = plannedFrame(run, job);
    recordShot(run, job, next);
    if (keepFrame(run, next)) {
      recordKept(run, pictures, job);
      run.kept.push_back(next.record);
    } else {
      drawFrame(run, pictures, job, next);
      writer.submit(std::move(next));
    }
    progress.done(++done);
  }
}

/// What a worker does with a frame.
DrawnFrame drawThere(const RenderRun& run, renderer::FrameRenderer& pictures, const Sink& sink,
                     const FrameJob& job) {
  FrameToWrite next = plannedFrame(run, job);
  if (keepFrame(run, next)) return {next.record, {}};
  drawFrame(run, pictures, job, next);
  return sink.encode(std::move(next));
}

std::string countText(std::size_t frames) {
  return std::to_string(frames) + (frames == 1 ? " frame" : " frames");
}

void tellStart(const RenderRun& run) {
  const Scene& scene = run.plan.scene;
  std::cerr << scene.name << ": " << run.scene.names.size() << " bodies, "
            << countText(run.plan.frames.size()) << " at " << run.manifest.fps << " fps, " << scene.rate_hz
            << " steps/s, camera " << run.manifest.camera << ", seed " << scene.seed << ", scene hash "
            << hexText(run.manifest.scene_hash) << '\n'
            << "GL: " << run.manifest.gl.renderer << ", " << run.manifest.gl.version << ", by "
            << renderer::nameOf(run.manifest.gl.backend) << " (" << run.manifest.gl.reason << ")\n";
}

/// What one file that holds the whole run says of itself.
renderer::PngText runText(const RenderRun& run) {
  return {{"Software", "carom " + programVersion()},
          {"Source", run.manifest.command},
          {"Scene hash", hexText(run.manifest.scene_hash)}};
}

/// "12 frames  0.41 s  29.3 fps end to end", of a run whose frames went through a pipe.
std::string pipedReport(const RenderRun& run) {
  return formatted("%s  %.2f s  %.1f fps end to end", countText(run.plan.frames.size()).c_str(),
                   run.manifest.wall_s, run.manifest.frames_planned / run.manifest.wall_s);
}

std::string filesReport(const RenderRun& run, const RunFacts& facts) {
  const Manifest& m = run.manifest;
  const FrameTimings total = totalTimings(m.frames);
  const double count = std::max<double>(1.0, static_cast<double>(m.frames.size()));
  const double drawn = std::max<double>(1.0, static_cast<double>(m.frames.size() - run.kept.size()));
  const std::string line =
      formatted("%s  %.2f s  %.1f fps end to end  physics %.2f ms  draw %.2f ms  encode %.2f ms",
                countText(m.frames.size()).c_str(), m.wall_s, count / m.wall_s, total.physics_ms / count,
                total.draw_ms / drawn, total.encode_ms / drawn);
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
void removeLeftOvers(const RenderRun& run, const std::string& manifest_name) {
  std::set<std::string> names{manifest_name, kRecordName};
  for (const int frame : run.plan.frames) {
    names.insert(run.names->file(frame).filename().string());
    for (const FrameOutput output : run.plan.outputs)
      names.insert(run.names->file(frame, nameOf(output)).filename().string());
  }
  removeAbandoned(run.names->folder(), names);
}

/// The records of the frames that this process has drawn, as far as it got; `ended_early` says why no
/// farther.
std::vector<FrameRecord> drawnHere(RenderRun& run, renderer::FrameRenderer& pictures, const Sink& sink,
                                   Progress& progress, std::exception_ptr& ended_early) {
  FrameWriter writer([&sink](FrameToWrite frame) -> std::optional<FrameRecord> {
    const DrawnFrame drawn = sink.encode(std::move(frame));
    if (!sink.deliver) return drawn.record;
    sink.deliver(drawn.bytes);
    return std::nullopt;
  });
  try {
    drawHere(run, pictures, writer, progress);
  } catch (const std::exception&) {
    ended_early = std::current_exception();
  }
  return writer.finish();
}

/// The same of its workers. One that cannot write ends the run without a manifest, as this process would.
std::vector<FrameRecord> drawnByWorkers(RenderRun& run, FrameWorkers& workers, const Sink& sink,
                                        Progress& progress, std::exception_ptr& ended_early) {
  std::vector<FrameRecord> written;
  int done = 0;
  const auto keep = [&](const DrawnFrame& drawn) {
    if (run.names != nullptr) (drawn.record.kept ? run.kept : written).push_back(drawn.record);
  };
  const auto collect = [&](const DrawnFrame& drawn) {
    if (sink.deliver) sink.deliver(drawn.bytes);
    keep(drawn);
    progress.done(++done);
  };
  try {
    for (const int frame : run.plan.frames) workers.submit(nextJob(run, frame), collect);
    workers.finish(collect);
  } catch (const std::exception&) {
    ended_early = std::current_exception();
    workers.giveUp(keep);
  }
  run.manifest.gl = workers.knownGl();
  return written;
}

/// Whether a run that ended so leaves no manifest: one that could not write, or had no renderer.
bool leavesNoManifest(const std::exception_ptr& ended_early) {
  if (!ended_early) return false;
  const int code = failureOf(ended_early).code;
  return code == static_cast<int>(ExitCode::kCannotWrite) || code == static_cast<int>(ExitCode::kNoRenderer);
}

/// Draws what is planned; a run that ends early still finishes the frames it has drawn and tells which they
/// are in its manifest.
void drawPlanned(RenderRun& run, const Artists& artists, const Sink& sink, const Telling& telling,
                 const std::filesystem::path& manifest_file, double started_s) {
  std::exception_ptr ended_early;
  std::vector<FrameRecord>& frames = run.manifest.frames;
  {
    const ProgressStyle style = progressStyle(telling.progress, telling.quiet);
    Progress progress({"frame", run.manifest.frames_planned}, style, std::cerr, steadySeconds);
    frames = artists.workers ? drawnByWorkers(run, *artists.workers, sink, progress, ended_early)
                             : drawnHere(run, *artists.here, sink, progress, ended_early);
  }
  frames.insert(frames.end(), run.kept.begin(), run.kept.end());
  std::sort(frames.begin(), frames.end(),
            [](const FrameRecord& a, const FrameRecord& b) { return a.frame < b.frame; });
  run.manifest.wall_s = steadySeconds() - started_s;
  if (run.names != nullptr && !leavesNoManifest(ended_early)) writeManifest(run.manifest, manifest_file);
  if (ended_early) std::rethrow_exception(ended_early);
  if (run.recorder != nullptr) run.recorder->write(run.names->folder(), run.manifest.gl);
}

void renderFiles(RenderRun& run, const Artists& artists, const RenderOptions& options, const Sink& sink,
                 const RunFacts& facts, double started_s) {
  const std::string manifest_name = manifestNameOf(options, *run.names);
  if (run.resume) removeLeftOvers(run, manifest_name);
  try {
    drawPlanned(run, artists, sink, options.telling, run.names->folder() / manifest_name, started_s);
  } catch (const ProcessFailure&) {
    removeLeftOvers(run, manifest_name);  // a worker that was killed could not
    throw;
  }
  if (!options.telling.quiet && !options.at_s) noteOlderFrames(*run.names, run.plan.frame_count);
  if (!options.telling.quiet) std::cout << filesReport(run, facts) << '\n';
}

void renderStream(RenderRun& run, const Artists& artists, const RenderOptions& options, Sink sink,
                  double started_s) {
  PipeWriter out(STDOUT_FILENO, "standard output");
  sink.deliver = [&out](std::span<const std::uint8_t> bytes) { out.write(bytes); };
  drawPlanned(run, artists, sink, options.telling, {}, started_s);
  if (!options.telling.quiet) std::cerr << pipedReport(run) << '\n';
}

void renderMovingPicture(RenderRun& run, const Artists& artists, const RenderOptions& options, Sink sink,
                         double started_s) {
  const std::unique_ptr<MovingPicture> picture =
      makeMovingPicture(options.moving, {options.width, options.height, run.manifest.fps},
                        run.manifest.frames_planned, runText(run));
  sink.deliver = [&picture](std::span<const std::uint8_t> bytes) { picture->write(bytes); };
  drawPlanned(run, artists, sink, options.telling, {}, started_s);
  picture->commit();
  if (!options.telling.quiet) std::cout << options.moving.string() << "  " << pipedReport(run) << '\n';
}

void renderSheet(RenderRun& run, const Artists& artists, const RenderOptions& options, Sink sink,
                 double started_s) {
  ContactSheet sheet(readSheet(options.sheet), options.width, options.height);
  std::size_t next = 0;
  sink.deliver = [&](std::span<const std::uint8_t> bytes) {
    sheet.add(bytes, run.plan.clock.time(run.plan.frames[next++]));
  };
  const std::string path =
      options.output.empty() ? "frames/" + run.plan.scene.name + "/sheet.png" : options.output;
  AtomicFile file(path);
  drawPlanned(run, artists, sink, options.telling, {}, started_s);
  file.write(encodePng(sheet.image(), runText(run)));
  file.commit();
  if (!options.telling.quiet) std::cout << path << "  " << pipedReport(run) << '\n';
}

/// How a frame is encoded for where it goes.
Sink sinkOf(const RenderOptions& options) {
  if (!options.moving.empty() || !options.sheet.empty())
    return {[](FrameToWrite frame) { return DrawnFrame{frame.record, std::move(frame.image.rgb)}; }, {}};
  if (options.stream.empty())
    return {[encoder = std::make_shared<FrameEncoder>()](FrameToWrite frame) {
              return DrawnFrame{*writeFrameFile(std::move(frame), *encoder), {}};
            },
            {}};
  const StreamFormat format = streamFormat(options.stream);
  return {[format](FrameToWrite frame) {
            return DrawnFrame{frame.record, frame.outputs.empty()
                                                ? streamedFrame(format, frame)
                                                : streamedOutput(format, frame.outputs.front())};
          },
          {}};
}

/// A record tells of a run as it goes: shards, streams, recordings and overlays, which watch the world
/// themselves, have none.
bool hasRecord(const RenderOptions& options, const Overlays& overlays) {
  return options.states && options.shard.empty() && options.from.empty() && options.stream.empty() &&
         options.moving.empty() && options.sheet.empty() && !options.at_s && !overlays.any();
}

/// Whether a part of the frames is drawn into a folder whose record is of others there too: it stays.
bool leavesRecord(const RenderOptions& options, const RenderPlan& plan, const FrameNames& names) {
  if (options.frames.empty()) return false;
  std::set<std::string> files;
  for (const int frame : plan.frames) files.insert(names.file(frame).filename().string());
  if (!recordIsOfOthers(names.folder(), files)) return false;
  if (!options.telling.quiet)
    std::cerr << "note: " << (names.folder() / kRecordName).string()
              << " is of other frames, too, and stays as it is; the whole run makes it anew\n";
  return true;
}

/// Overlays need the engine itself, and so does a still. A record holds pixels, which are drawn where it is
/// kept.
int workersOf(const RenderOptions& options, const RenderPlan& plan, const Overlays& overlays) {
  const int frames = static_cast<int>(plan.frames.size());
  if (overlays.any() || options.at_s || hasRecord(options, overlays) || frames < 2) return 1;
  return std::min(frames, options.workers > 0 ? options.workers : usualWorkers(frames));
}

Json meshesJson(const std::vector<std::pair<std::string, MeshReport>>& meshes) {
  Json list = Json::array();
  for (const auto& [body, report] : meshes)
    list.push(Json::object({{"body", body}, {"mesh", report.json()}}));
  return list;
}

}  // namespace

ExitCode render(const RenderOptions& options) {
  const double started_s = steadySeconds();
  if (!options.stream.empty()) streamFormat(options.stream);
  if (!options.stream.empty() && ::isatty(STDOUT_FILENO) != 0)
    throw UsageError("-o -: standard output is a terminal; accepted: a pipe or a file");
  std::optional<RecordingReader> recording;
  if (!options.from.empty()) recording.emplace(options.from);
  const OverlayChoice shown = readOverlays(options.overlays);
  const RenderPlan plan = planned(options, recording);
  if (plan.cutout) requireAlpha(options, shown);
  if (!options.stream.empty()) requireStreamable(options, plan.outputs);
  const std::optional<FrameNames> names = frameNames(options, plan.scene.name);
  Manifest manifest = emptyManifest(options, plan);

  SceneWorld made = makeSceneWorld(plan.scene, plan.choice.mesh, threadsOf(plan.choice));
  if (!made.meshes.empty()) manifest.meshes = meshesJson(made.meshes);
  Overlays overlays({shown, options.focus, recording.has_value()}, made, plan.clock);
  manifest.overlays = overlays.identity();
  manifest.has_caption = options.caption && !plan.scene.caption.empty();
  const CameraPath camera(plan.camera.camera, made, static_cast<double>(options.width) / options.height);
  const SceneCaption caption(plan.scene, made);
  const OutputScale scale = outputScale(drawnInstances(made, made.world.states()), made.drawnSolids(),
                                        camera.at(0.0, made.world.states()));
  if (!plan.outputs.empty()) manifest.outputs = outputsJson(plan.outputs, scale, made.names);
  renderer::Settings settings =
      pictureSettings(plan.light, {options.width, options.height, options.gl, plan.preset});
  settings.style = plan.style;
  settings.cutout = plan.cutout;
  if (options.portable) settings.pixels = renderer::PixelPolicy::kPortable;
  const int workers_wanted = workersOf(options, plan, overlays);
  std::optional<FolderClaim> claim;
  if (names) claim.emplace(folderClaim(options, manifest, *names));
  std::optional<renderer::FrameRenderer> here;
  if (workers_wanted == 1) {
    here.emplace(settings, made.drawnSolids());
    manifest.gl = here->info();
  }
  RunFacts facts;
  std::optional<MotionRecorder> recorder;
  if (hasRecord(options, overlays) && !leavesRecord(options, plan, *names)) {
    recorder.emplace(plan.scene, made, settings);
    if (options.resume) recorder->recall(names->folder());
    if (manifest.has_caption) recorder->addLook("caption", "on");
    if (manifest.shutter_degrees > 0.0)
      recorder->addLook("shutter", formatted("%.9g degrees", manifest.shutter_degrees));
  }
  const FrameClock fine_clock =
      plan.shutter.isOpen() ? FrameClock({plan.clock.fps() * plan.shutter.perFrame(), plan.scene.rate_hz})
                            : plan.clock;
  std::optional<FrameSource> source;
  if (recording)
    source.emplace(*recording);
  else
    source.emplace(made, fine_clock, facts, overlays.phases(), [&recorder](const World& world) {
      if (recorder) recorder->follow(world);
    });
  RenderRun run{plan,
                names ? &*names : nullptr,
                options.resume,
                made,
                *source,
                camera,
                manifest.has_caption ? &caption : nullptr,
                scale,
                overlays,
                manifest,
                recorder ? &*recorder : nullptr,
                {}};
  const Sink sink = sinkOf(options);

  catchInterrupts();
  std::optional<FrameWorkers> workers;
  if (workers_wanted > 1) {
    settings.gl_threads = 1;
    workers.emplace(workers_wanted, [&](renderer::ContextInfo& gl) -> FrameWorkers::Draw {
      const auto pictures = std::make_shared<renderer::FrameRenderer>(settings, made.drawnSolids());
      gl = manifest.gl = pictures->info();
      return [&, pictures](const FrameJob& job) { return drawThere(run, *pictures, sink, job); };
    });
  }
  if (options.telling.verbose) {
    if (workers) manifest.gl = workers->gl();
    tellStart(run);
  }
  const Artists artists{workers, here};
  if (run.names != nullptr)
    renderFiles(run, artists, options, sink, facts, started_s);
  else if (!options.stream.empty())
    renderStream(run, artists, options, sink, started_s);
  else if (!options.moving.empty())
    renderMovingPicture(run, artists, options, sink, started_s);
  else
    renderSheet(run, artists, options, sink, started_s);
  return ExitCode::kOk;
}

}  // namespace carom::demos
