// `carom budget`: whether a scene's frames keep a deadline on this machine, and which phase takes the time.
#include "demos/command/command.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "demos/against/against_result.h"
#include "demos/against/paced_frames.h"
#include "demos/against/paced_program.h"
#include "demos/budget/budget_run.h"
#include "demos/format/content_hash.h"
#include "demos/format/progress.h"
#include "demos/frames/picture_settings.h"
#include "demos/report/budget_json.h"
#include "demos/report/budget_plot.h"
#include "demos/report/budget_report.h"
#include "demos/report/trace_events.h"
#include "demos/scene/written_files.h"
#include "demos/system/atomic_file.h"
#include "demos/system/build_info.h"
#include "demos/system/interrupt.h"
#include "demos/system/machine_load.h"

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
  subject.preset = options.preset + (options.light.empty() ? "" : " by " + options.light);
  subject.threads = threadsOf(options.choice);
  subject.machine = machineName();
  subject.build = buildName();
  subject.clock = options.clock;
  return subject;
}

void writeText(const std::string& path, const std::string& text) {
  if (path == kStandardOutput) {
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
  if (!options.trace.empty()) writeText(options.trace, traceText(result));
  if (options.json != kStandardOutput && options.csv != kStandardOutput && options.trace != kStandardOutput) {
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

std::string plotTitle(const BudgetOptions& options) {
  std::ostringstream title;
  title << "carom budget " << options.choice.scene << ", " << options.width << "x" << options.height << ", "
        << options.preset << (options.clock == "cpu" ? ", CPU time" : "");
  return title.str();
}

void writePlot(const std::filesystem::path& path, const BudgetPlot& plot) {
  writeText(path.string(), path.extension() == ".html" ? plotPage(plot) : plotSvg(plot));
}

/// The least times of the rounds, as those of replays.
BudgetPlot plotOf(const BudgetOptions& options, const std::vector<AgainstRound>& rounds,
                  const AgainstResult& result) {
  std::vector<Replay> now, other;
  for (const AgainstRound& round : rounds) {
    now.push_back({round.now, {}});
    other.push_back({round.other, {}});
  }
  BudgetPlot plot{plotTitle(options),           leastCosts(now), 0.0,
                  totals_ms(leastCosts(other)), options.against, {}};
  for (std::size_t i = 0; i < plot.frames.size(); ++i) {
    plot.frames[i].frame = static_cast<int>(i);
    plot.frames[i].time_s = static_cast<double>(i) / options.fps;
  }
  plot.notes.push_back(againstLines(result).back());
  return plot;
}

/// Words of a command line, with quotes of either kind.
std::vector<std::string> commandWords(const std::string& text) {
  std::vector<std::string> words;
  bool open = false;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote)
        quote = 0;
      else
        words.back() += c;
      continue;
    }
    if (c == ' ') {
      open = false;
      continue;
    }
    if (!open) words.emplace_back();
    open = true;
    if (c == '"' || c == '\'')
      quote = c;
    else
      words.back() += c;
  }
  return words;
}

/// The command line without --against and what is told of it, for one paced run.
std::vector<std::string> pacedWords(const BudgetOptions& options, const std::vector<std::string>& program) {
  const std::vector<std::string> own = {"--against", "--json", "--plot"};
  std::vector<std::string> words = {program[0]};
  for (std::size_t i = 0; i < options.words.size(); ++i) {
    const std::string& word = options.words[i];
    const bool is_own = std::any_of(own.begin(), own.end(), [&](const std::string& name) {
      return word == name || word.rfind(name + "=", 0) == 0;
    });
    if (!is_own)
      words.push_back(word);
    else if (word.find('=') == std::string::npos)
      ++i;
  }
  std::vector<std::string> more(program.begin() + 1, program.end());
  more.emplace_back("--paced");
  words.insert(std::find(words.begin(), words.end(), "--"), more.begin(), more.end());
  return words;
}

/// Times of the CPU are of one processor, for two of them are seldom equally quick: the next one after two
/// rounds, so that on each of them either program starts first.
std::optional<int> processorOf(const BudgetOptions& options, int round) {
  const std::vector<int> all = usableProcessors();
  if (options.clock != "cpu" || all.empty()) return {};
  return all[static_cast<std::size_t>(round / 2) % all.size()];
}

/// Both processes afresh; in turns A B, B A.
AgainstRound playedRound(const BudgetOptions& options, const std::vector<std::string>& other, int round,
                         Progress& progress, int& done) {
  AgainstRound played;
  // Who starts first changes from round to round as well.
  const std::optional<int> processor = processorOf(options, round);
  std::optional<PacedProgram> a, b;
  if (round % 2 == 0) a.emplace(pacedWords(options, {"/proc/self/exe"}), "carom", processor);
  b.emplace(pacedWords(options, other), other[0], processor);
  if (!a) a.emplace(pacedWords(options, {"/proc/self/exe"}), "carom", processor);
  const int frames = a->awaitReady();
  if (const int others = b->awaitReady(); others != frames)
    throw InputError("--against: " + other[0] + " has " + std::to_string(others) + " frames, not " +
                     std::to_string(frames) + "; accepted: the same scene at the same --fps and --duration");
  for (int frame = 0; frame < frames; ++frame) {
    const bool a_first = (frame + round) % 2 == 0;
    if (a_first) played.now.push_back(a->next());
    played.other.push_back(b->next());
    if (!a_first) played.now.push_back(a->next());
    progress.done(++done);
  }
  return played;
}

ExitCode budgetAgainst(const BudgetOptions& options) {
  const std::vector<std::string> other = commandWords(options.against);
  if (other.empty()) throw UsageError("--against: accepted: a carom program, and options of its own");
  const Scene scene = chosenScene(options.choice);
  const int frames = FrameClock({options.fps, scene.rate_hz}).frameCount(scene.duration_s);
  if (frames < 1) throw UsageError("--against: the run has no frame");
  catchInterrupts();
  std::vector<AgainstRound> rounds;
  {
    const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
    Progress progress({"pair", frames * options.replays}, style, std::cerr, steadySeconds);
    int done = 0;
    for (int round = 0; round < options.replays; ++round)
      rounds.push_back(playedRound(options, other, round, progress, done));
  }
  const AgainstResult result = judgedAgainst(rounds, options.against, options.clock);
  if (!options.plot.empty()) writePlot(options.plot, plotOf(options, rounds, result));
  if (!options.json.empty()) writeText(options.json, againstJson(result).text(2) + "\n");
  if (options.json != kStandardOutput)
    for (const std::string& line : againstLines(result)) std::cout << line << '\n';
  if (result.frame.speed == Speed::kSlower) return ExitCode::kNo;
  for (const SpeedChange& phase : result.phases)
    if (phase.speed == Speed::kSlower) return ExitCode::kNo;
  if (result.frame.speed == Speed::kFaster) return ExitCode::kOk;
  // What could not have been seen is not said to be absent.
  return result.frame.smallest > 0.01 * options.tolerance_percent ? ExitCode::kInconclusive : ExitCode::kOk;
}

}  // namespace

ExitCode budget(const BudgetOptions& options) {
  if (!options.against.empty()) return budgetAgainst(options);
  const Scene scene = chosenScene(options.choice);
  const NamedCamera camera = chosenCamera(scene, options.camera);
  const FrameClock clock({options.fps, scene.rate_hz});
  const int frames = clock.frameCount(scene.duration_s);
  if (!options.paced) requireFrames(options, frames);
  std::optional<Baseline> baseline;
  if (!options.baseline.empty()) baseline = readBaseline(options.baseline);

  BudgetSubject subject = subjectOf(options, scene, camera.name, frames);
  const SceneWorld made = makeSceneWorld(scene, options.choice.mesh);
  const renderer::Settings settings =
      pictureSettings(chosenLight(scene.light, options.light, {}),
                      {options.width, options.height, options.gl, renderer::presetOf(options.preset)});
  renderer::FrameRenderer pictures(settings, made.drawnSolids());
  subject.renderer = pictures.info().renderer + ", " + pictures.info().version;
  // Work is the same on every machine; times are not.
  if (baseline)
    baseline->hasWork() ? requireSameRun(*baseline, subject) : requireSameSubject(*baseline, subject);

  catchInterrupts();
  const CameraPath path(camera.camera, made, static_cast<double>(options.width) / options.height);
  const ReplayPlan plan{.scene = scene,
                        .mesh = options.choice.mesh,
                        .clock = clock,
                        .camera = path,
                        .frames = frames,
                        .replays = options.replays,
                        .threads = subject.threads,
                        .keeps_slices = !options.trace.empty(),
                        .clock_s = options.clock == "cpu" ? processSeconds : steadySeconds};
  if (options.paced) {
    servePacedFrames(plan, pictures);
    return ExitCode::kOk;
  }
  const MachineLoad load;
  std::vector<Replay> replays;
  {
    const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
    Progress progress({"frame", frames * options.replays}, style, std::cerr, steadySeconds);
    replays = runReplays(plan, pictures, [&progress](int done) { progress.done(done); });
  }
  // What others take of the CPU is not in CPU time.
  const std::optional<double> outside = options.clock == "cpu" ? std::optional(0.0) : load.outsideShare();
  const BudgetResult result =
      judged(subject, {options.budget_ms, options.percentile}, std::move(replays), outside);
  std::optional<BaselineComparison> comparison;
  if (baseline)
    comparison =
        comparedToBaseline(result, *baseline, options.tolerance_percent, options.work_tolerance_percent);
  if (!options.plot.empty())
    writePlot(options.plot, {plotTitle(options),
                             result.least,
                             options.budget_ms,
                             baseline ? baseline->frame_times_ms : std::vector<double>{},
                             baseline ? baseline->file : "",
                             {verdictLine(result)}});
  tell(options, result, comparison ? &*comparison : nullptr);
  const ExitCode code = exitCodeOf(result.verdict, comparison ? comparison->verdict : BudgetVerdict::kWithin);
  if (code == ExitCode::kInconclusive && options.clock == "wall" && !options.telling.quiet)
    std::cerr << "note: --clock cpu leaves out what others take; --against compares with another program on "
                 "any machine\n";
  return code;
}

}  // namespace carom::demos
