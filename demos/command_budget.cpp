// `carom budget`: whether a scene's frames keep a deadline on this machine, and which phase takes the time.
#include "demos/command.h"

#include <cmath>
#include <iostream>
#include <sstream>

#include "demos/atomic_file.h"
#include "demos/budget_json.h"
#include "demos/budget_report.h"
#include "demos/budget_run.h"
#include "demos/build_info.h"
#include "demos/content_hash.h"
#include "demos/interrupt.h"
#include "demos/machine_load.h"
#include "demos/progress.h"
#include "demos/trace_events.h"

namespace carom::demos {
namespace {

void requireFrames(const BudgetOptions& options, int frames) {
  const int needed = framesNeeded(options.percentile);
  if (frames >= needed) return;
  std::ostringstream message;
  message << "budget: " << percentileName(options.percentile) << " needs " << needed
          << " frames, and this run has " << frames << "; accepted: --duration " << needed / options.fps
          << " or longer at " << options.fps << " fps";
  if (frames > 1)
    message << ", or --percentile " << std::floor(10.0 * (100.0 - 100.0 / frames)) / 10.0 << " or lower";
  throw UsageError(message.str());
}

BudgetSubject subjectOf(const BudgetOptions& options, const Scene& scene, const std::string& camera,
                        int frames) {
  BudgetSubject subject;
  subject.scene = scene.name;
  subject.scene_hash = hexText(sceneHash(scene, options.choice.mesh));
  subject.width = options.width;
  subject.height = options.height;
  subject.fps = options.fps;
  subject.frames = frames;
  subject.camera = camera;
  subject.preset = options.preset;
  subject.threads = threadsOf(options.choice);
  subject.machine = machineName();
  subject.build = buildName();
  return subject;
}

void writeText(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text;
    return;
  }
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void tell(const BudgetOptions& options, const BudgetResult& result, const BaselineComparison* comparison) {
  if (!options.json.empty()) writeText(options.json, budgetJson(result, comparison).text(2) + "\n");
  if (!options.csv.empty()) writeText(options.csv, budgetCsv(result));
  if (!options.trace.empty()) writeTrace(result, options.trace);
  if (options.json != "-" && options.csv != "-") {
    std::cout << budgetReport(result, comparison);
    return;
  }
  if (options.telling.quiet) return;
  if (comparison != nullptr)
    for (const std::string& line : baselineLines(*comparison)) std::cerr << line << '\n';
  std::cerr << verdictLine(result) << '\n';
}

/// A no outweighs a don't know, and that a yes.
ExitCode exitCodeOf(BudgetVerdict budget, BudgetVerdict baseline) {
  if (budget == BudgetVerdict::kOver || baseline == BudgetVerdict::kOver) return ExitCode::kNo;
  if (budget == BudgetVerdict::kInconclusive || baseline == BudgetVerdict::kInconclusive)
    return ExitCode::kInconclusive;
  return ExitCode::kOk;
}

}  // namespace

ExitCode budget(const BudgetOptions& options) {
  const Scene scene = chosenScene(options.choice);
  const NamedCamera camera = chosenCamera(scene, options.camera);
  const FrameClock clock({options.fps, scene.rate_hz});
  const int frames = clock.frameCount(scene.duration_s);
  requireFrames(options, frames);
  std::optional<Baseline> baseline;
  if (!options.baseline.empty()) baseline = readBaseline(options.baseline);

  BudgetSubject subject = subjectOf(options, scene, camera.name, frames);
  const SceneWorld made = makeSceneWorld(scene, options.choice.mesh);
  renderer::Settings settings{.width = options.width, .height = options.height};
  settings.backend = renderer::backendOf(options.gl);
  settings.preset = renderer::presetOf(options.preset);
  renderer::FrameRenderer pictures(settings, made.world.solids());
  subject.renderer = pictures.info().renderer + ", " + pictures.info().version;
  if (baseline) requireSameSubject(*baseline, subject);

  catchInterrupts();
  const CameraPath path(camera.camera, made, static_cast<double>(options.width) / options.height);
  const ReplayPlan plan{.scene = scene,
                        .mesh = options.choice.mesh,
                        .clock = clock,
                        .camera = path,
                        .frames = frames,
                        .replays = options.replays,
                        .threads = subject.threads,
                        .keeps_slices = !options.trace.empty()};
  const MachineLoad load;
  std::vector<Replay> replays;
  {
    const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
    Progress progress({"frame", frames * options.replays}, style, std::cerr, steadySeconds);
    replays = runReplays(plan, pictures, [&progress](int done) { progress.done(done); });
  }
  const BudgetResult result =
      judged(subject, {options.budget_ms, options.percentile}, std::move(replays), load.outsideShare());
  std::optional<BaselineComparison> comparison;
  if (baseline) comparison = comparedToBaseline(result, *baseline, options.tolerance_percent);
  tell(options, result, comparison ? &*comparison : nullptr);
  return exitCodeOf(result.verdict, comparison ? comparison->verdict : BudgetVerdict::kWithin);
}

}  // namespace carom::demos
