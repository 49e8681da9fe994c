// `carom export`: a scene's motion, simulated or recorded, for other programs: animated glTF, CSV, NumPy, and
// for people: a page that plays it.
#include "demos/command/command.h"

#include <iostream>
#include <optional>
#include <sstream>

#include "demos/asset/asset_path.h"
#include "demos/format/progress.h"
#include "demos/language/scene_values.h"
#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_source.h"
#include "demos/page/player_page.h"
#include "demos/record/motion_gltf.h"
#include "demos/record/recorded_scene.h"
#include "demos/scene/scene_world.h"
#include "demos/system/atomic_file.h"
#include "demos/system/interrupt.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr double kDefaultFps = 30.0;
constexpr double kDefaultPageFps = 60.0;

bool isPage(const std::filesystem::path& output) {
  return output.extension() == ".html";
}

/// A file that is no scene; shipped names go before files of that name.
bool isRecording(const std::filesystem::path& path) {
  std::error_code ignored;
  if (path.extension() == ".json") return false;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    if (path.has_extension()) throw InputError(path.string() + ": no such scene or recording");
    return false;
  }
  for (const std::filesystem::path& scene : shippedScenes())
    if (scene.stem() == path) return false;
  return true;
}

/// What is to be exported, settled before anything is made.
struct Plan {
  SceneChoice choice;
  Scene scene;
  FrameClock clock;
  int frames = 0;
};

void refuseOptionsOfScenes(const ExportOptions& options) {
  const char* refused = options.choice.seed         ? "--seed"
                        : options.choice.duration_s ? "--duration"
                        : options.fps               ? "--fps"
                                                    : nullptr;
  if (refused == nullptr) return;
  throw UsageError(std::string(refused) + " is for scenes: " + options.choice.scene +
                   " is a recording, which has its own");
}

Plan recordedPlan(const ExportOptions& options, const RecordingReader& recording) {
  refuseOptionsOfScenes(options);
  const std::filesystem::path file = options.choice.scene;
  SceneChoice choice = options.choice;
  const NamedFile read{"the recording", file};
  requireNotRead(choice.written, {&read, 1});
  choice.scene = options.moved.string();
  choice = recordedChoice({file, recording.header()}, choice, "export --scene");
  const Scene scene = chosenScene(choice);
  requireSameScene({file, recording.header()}, scene, choice);
  if (recording.header().frames < 1) throw InputError(file.string() + ": holds no frame");
  return {choice, scene, FrameClock({recording.header().fps, scene.rate_hz}), recording.header().frames};
}

Plan simulatedPlan(const ExportOptions& options) {
  if (!options.moved.empty())
    throw UsageError("--scene is for recordings: " + options.choice.scene + " is a scene itself");
  const Scene scene = chosenScene(options.choice);
  const double usual_fps = isPage(options.output) ? kDefaultPageFps : kDefaultFps;
  const FrameClock clock({options.fps.value_or(usual_fps), scene.rate_hz});
  const int frames = clock.frameCount(scene.duration_s);
  if (frames < 1)
    throw UsageError("the duration of " + plainNumber(scene.duration_s) + " s holds no frame to export");
  return {options.choice, scene, clock, frames};
}

/// As somebody would type it beside the files.
std::string shownCommand(const ExportOptions& options) {
  std::ostringstream command;
  command << "carom export " << std::filesystem::path(options.choice.scene).filename().string() << ' '
          << options.output.filename().string();
  for (const std::string& setting : options.choice.settings) command << " --set '" << setting << '\'';
  if (options.choice.seed) command << " --seed " << *options.choice.seed;
  if (options.choice.duration_s) command << " --duration " << *options.choice.duration_s;
  if (options.fps) command << " --fps " << *options.fps;
  return command.str();
}

/// A .glb or .html file that appears whole or not at all.
class MotionFile {
 public:
  MotionFile(const ExportOptions& options, const Plan& plan, SceneWorld& made) : file_(options.output) {
    if (isPage(options.output))
      page_.emplace(plan.scene, made, pageChoice(options, plan));
    else
      gltf_.emplace(plan.scene, made, plan.frames);
  }
  void add(int frame, double time_s, std::span<const BodyState> states) {
    if (gltf_) gltf_->add(time_s, states);
    if (page_) page_->add(frame, states);
  }
  void commit() {
    file_.write(gltf_ ? gltf_->bytes() : page_->html());
    file_.commit();
  }

 private:
  static PageChoice pageChoice(const ExportOptions& options, const Plan& plan) {
    return {.fps = plan.clock.fps(),
            .frames = plan.frames,
            .recorded = isRecording(options.choice.scene),
            .command = shownCommand(options),
            .index = ""};
  }

  AtomicFile file_;
  std::optional<MotionGltf> gltf_;
  std::optional<PlayerPage> page_;
};

void printReport(const ExportOptions& options, const Plan& plan, const SceneWorld& made) {
  if (options.telling.quiet) return;
  std::ostream& out = options.trajectory.csv == kStandardOutput ? std::cerr : std::cout;
  for (const std::filesystem::path& path : {options.output, options.trajectory.csv, options.trajectory.npy})
    if (!path.empty() && path != kStandardOutput) out << path.string() << "  ";
  out << plan.frames << " frames at " << plan.clock.fps() << " fps, " << made.names.size() << " bodies\n";
}

}  // namespace

ExitCode exportMotion(const ExportOptions& options) {
  std::optional<RecordingReader> recording;
  if (isRecording(options.choice.scene)) recording.emplace(options.choice.scene);
  const Plan plan = recording ? recordedPlan(options, *recording) : simulatedPlan(options);
  SceneWorld made = makeSceneWorld(plan.scene, plan.choice.mesh, threadsOf(plan.choice));
  RunFacts facts;
  std::optional<FrameSource> source;
  if (recording)
    source.emplace(*recording);
  else
    source.emplace(made, plan.clock, facts);

  catchInterrupts();
  std::optional<MotionFile> file;
  if (!options.output.empty()) file.emplace(options, plan, made);
  TrajectoryFiles trajectory(options.trajectory, made.names, plan.frames);
  {
    const Telling& telling = options.telling;
    const ProgressStyle style = progressStyle(telling.progress, telling.quiet);
    Progress progress({"frame", plan.frames}, style, std::cerr, steadySeconds);
    for (int frame = 0; frame < plan.frames; ++frame) {
      const FrameState state = source->at(frame);
      if (file) file->add(frame, plan.clock.time(frame), state.bodies);
      trajectory.add(plan.clock.time(frame), state.bodies);
      progress.done(frame + 1);
    }
  }
  if (file) file->commit();
  trajectory.commit();
  printReport(options, plan, made);
  return ExitCode::kOk;
}

}  // namespace carom::demos
