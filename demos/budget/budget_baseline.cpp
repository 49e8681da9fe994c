#include "demos/budget/budget_baseline.h"

#include <algorithm>
#include <cstdlib>

#include "demos/asset/asset_path.h"
#include "demos/format/formatted.h"
#include "demos/format/json.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

int count(const Json& json) {
  const double value = json.asNumber();
  if (!(value >= 0.0 && value <= 1e9)) json.fail("is " + json.shown() + "; accepted: 0 to 1000000000");
  return static_cast<int>(value);
}

BudgetSubject readSubject(const Json& json) {
  BudgetSubject s;
  s.scene = json.at("scene").asString();
  s.scene_hash = json.at("sceneHash").asString();
  s.width = count(json.at("width"));
  s.height = count(json.at("height"));
  s.fps = json.at("fps").asNumber();
  s.frames = count(json.at("frames"));
  s.camera = json.at("camera").asString();
  const Json* preset = json.find("preset");  // older files name none
  s.preset = preset != nullptr ? preset->asString() : "realtime";
  const Json* threads = json.find("threads");
  s.threads = threads != nullptr ? count(*threads) : 1;
  s.machine = json.at("machine").asString();
  s.renderer = json.at("renderer").asString();
  s.build = json.at("build").asString();
  if (const Json* clock = json.find("clock")) s.clock = clock->asString();
  return s;
}

double positive(const Json& json) {
  const double value = json.asNumber();
  if (!(value >= 0.0)) json.fail("is " + json.shown() + "; accepted: a time of 0 or more");
  return value;
}

std::vector<double> replayMeans(const BudgetResult& result, const auto& timesOf) {
  std::vector<double> means;
  for (const Replay& replay : result.replays) means.push_back(distributionOf(timesOf(replay.frames)).mean);
  return means;
}

PhaseChange change(const std::string& name, const std::string& figure, double before_ms,
                   const TimeEvidence& evidence) {
  PhaseChange change{name, figure, before_ms, evidence, BudgetVerdict::kWithin};
  // Whether noise hides a "within" is no question here: the least time was reached.
  if (evidence.least_ms > evidence.limit_ms) change.verdict = verdictOf(evidence);
  return change;
}

std::string changeLine(const PhaseChange& c, double tolerance_percent) {
  const double growth = c.before_ms > 0.0 ? 100.0 * (c.evidence.least_ms / c.before_ms - 1.0) : 100.0;
  const std::string line =
      formatted("%s: %s, %s %.3g ms, was %.3g ms (+%.0f %%, tolerance %.3g %%)",
                c.verdict == BudgetVerdict::kOver ? "slower" : "inconclusive", c.name.c_str(),
                c.figure.c_str(), c.evidence.least_ms, c.before_ms, growth, tolerance_percent);
  return c.verdict == BudgetVerdict::kOver ? line : line + (", but " + noiseText(c.evidence));
}

/// Of a file that tells of work: all kinds that this program knows, by name.
void readWork(const Json& json, Baseline& baseline) {
  for (std::size_t w = 0; w < kWorkKinds; ++w)
    for (const Json& kind : json.items()) {
      if (kind.at("name").asString() != kWork[w].name) continue;
      for (const Json& frame : kind.at("frames").items())
        baseline.work[w].push_back(static_cast<std::int64_t>(frame.asNumber()));
      if (baseline.work[w].size() != static_cast<std::size_t>(baseline.subject.frames))
        kind.at("frames").fail("holds " + std::to_string(baseline.work[w].size()) + " counts; accepted: " +
                               std::to_string(baseline.subject.frames) + ", one a frame");
    }
}

std::vector<WorkChange> workChanges(const BudgetResult& result, const Baseline& baseline,
                                    double tolerance_percent) {
  std::vector<WorkChange> changes;
  for (std::size_t w = 0; w < kWorkKinds; ++w) {
    const std::vector<std::int64_t>& was = baseline.work[w];
    if (was.size() != result.least.size()) continue;
    WorkChange change;
    bool differs = false;
    for (std::size_t i = 0; i < was.size(); ++i) {
      const std::int64_t is = result.least[i].work[w];
      change.before += was[i];
      change.now += is;
      // Within each frame, so that one frame's growth does not hide behind another's saving.
      if (static_cast<double>(is) > static_cast<double>(was[i]) * (1.0 + 0.01 * tolerance_percent))
        change.is_over = true;
      if (differs || is == was[i]) continue;
      differs = true;
      change.first_frame = static_cast<int>(i);
      change.frame_before = was[i];
      change.frame_now = is;
    }
    change.kind = w;
    if (differs) changes.push_back(change);
  }
  return changes;
}

/// Whether anything was counted at all.
bool tellsOfWork(const Baseline& baseline) {
  for (const std::vector<std::int64_t>& counts : baseline.work)
    for (const std::int64_t count : counts)
      if (count != 0) return true;
  return false;
}
bool tellsOfWork(const BudgetResult& result) {
  return std::any_of(result.least.begin(), result.least.end(),
                     [](const FrameCost& f) { return f.work != WorkCounts{}; });
}

std::string growthText(const WorkChange& c) {
  if (c.before == 0) return "new";
  return formatted("%+.3g %%", 100.0 * (static_cast<double>(c.now) / static_cast<double>(c.before) - 1.0));
}

/// What the work of a phase says of its time; empty where none of its work is counted.
std::string workOf(const BaselineComparison& comparison, const std::string& phase) {
  bool counted = false;
  std::string grown;
  for (std::size_t w = 0; w < kWorkKinds; ++w)
    counted = counted || kFramePhaseNames[static_cast<std::size_t>(kWork[w].phase)] == phase;
  for (const WorkChange& c : comparison.work)
    if (kFramePhaseNames[static_cast<std::size_t>(kWork[c.kind].phase)] == phase && c.now > c.before)
      grown += std::string(grown.empty() ? "" : ", ") + kWork[c.kind].name + " " + growthText(c);
  if (!comparison.has_work || !counted) return "";
  return grown.empty() ? "; with no more work" : "; with more work: " + grown;
}

bool isSlower(const BaselineComparison& comparison, FramePhase phase) {
  for (const PhaseChange& c : comparison.changes)
    if (c.name == kFramePhaseNames[static_cast<std::size_t>(phase)] && c.verdict != BudgetVerdict::kWithin)
      return true;
  return false;
}

void addWorkLines(const BaselineComparison& comparison, std::vector<std::string>& lines) {
  for (const WorkChange& c : comparison.work) {
    const WorkKind& kind = kWork[c.kind];
    std::string line = c.is_over          ? "more work: "
                       : c.now > c.before ? "more work, within the tolerance: "
                                          : "less work: ";
    line += std::string(kind.name) + ", " + std::to_string(c.now) + ", was " + std::to_string(c.before) +
            " (" + growthText(c) + "), first at frame " + std::to_string(c.first_frame) + ": " +
            std::to_string(c.frame_now) + ", was " + std::to_string(c.frame_before);
    if (c.now > c.before && comparison.other_machine.empty() && !isSlower(comparison, kind.phase))
      line += "; in no more time";
    lines.push_back(line);
  }
  if (comparison.has_work && comparison.work.empty())
    lines.push_back("the same work in every frame as in " + comparison.file);
  if (comparison.other_states)
    lines.push_back("the run ends in another state than that of " + comparison.file +
                    ": it is another motion");
}

}  // namespace

Baseline readBaseline(const std::filesystem::path& path) {
  const Json json = Json::parse(readTextFile(path), path.string());
  Baseline baseline;
  baseline.file = path.string();
  baseline.subject = readSubject(json.at("subject"));
  baseline.percent = json.at("percentile").asNumber();
  baseline.frame_mean_ms = positive(json.at("frame_ms").at("mean"));
  baseline.at_percentile_ms = positive(json.at("frame_ms").at("atPercentile"));
  const Json& phases = json.at("phases_ms");
  if (phases.items().size() != kFramePhases)
    phases.fail("holds " + std::to_string(phases.items().size()) + " phases; accepted: the " +
                std::to_string(kFramePhases) + " of carom budget --json");
  for (std::size_t p = 0; p < kFramePhases; ++p) {
    const Json& phase = phases.items()[p];
    if (phase.at("name").asString() != kFramePhaseNames[p])
      phase.at("name").fail("is " + phase.at("name").shown() + "; accepted: \"" + kFramePhaseNames[p] + "\"");
    baseline.phase_mean_ms[p] = positive(phase.at("mean"));
  }
  if (const Json* work = json.find("work")) readWork(*work, baseline);
  if (const Json* times = json.find("frameTimes_ms"))
    for (const Json& time : times->items()) baseline.frame_times_ms.push_back(positive(time));
  if (const Json* state = json.find("finalState"))
    baseline.final_state = std::strtoull(state->asString().c_str(), nullptr, 16);
  return baseline;
}

namespace {

[[noreturn]] void refuse(const Baseline& baseline, const std::string& difference) {
  throw InputError(baseline.file + ": is of another " + difference +
                   "; times can be compared only where all but the program is the same");
}

/// The first of these that differs: "size: 640x360, not 320x180".
std::string differenceIn(std::initializer_list<std::array<std::string, 3>> facts) {
  for (const auto& [what, before, now] : facts)
    if (before != now) return what + ": " + before + ", not " + now;
  return "";
}

}  // namespace

void requireSameRun(const Baseline& baseline, const BudgetSubject& subject) {
  const BudgetSubject& was = baseline.subject;
  const auto size = [](const BudgetSubject& s) {
    return std::to_string(s.width) + "x" + std::to_string(s.height);
  };
  const auto length = [](const BudgetSubject& s) {
    return std::to_string(s.frames) + " frames at " + percentileName(s.fps).substr(1) + " fps";
  };
  const std::string difference =
      differenceIn({{"scene", was.scene, subject.scene},
                    {"content of the scene (file, meshes or seed)", was.scene_hash, subject.scene_hash},
                    {"size", size(was), size(subject)},
                    {"length", length(was), length(subject)},
                    {"camera", was.camera, subject.camera},
                    {"preset", was.preset, subject.preset}});
  if (!difference.empty()) refuse(baseline, difference);
}

std::string otherMachine(const Baseline& baseline, const BudgetSubject& subject) {
  const BudgetSubject& was = baseline.subject;
  return differenceIn({{"number of threads", std::to_string(was.threads), std::to_string(subject.threads)},
                       {"machine", was.machine, subject.machine},
                       {"renderer", was.renderer, subject.renderer},
                       {"build", was.build, subject.build},
                       {"clock", was.clock, subject.clock}});
}

void requireSameSubject(const Baseline& baseline, const BudgetSubject& subject) {
  requireSameRun(baseline, subject);
  const std::string difference = otherMachine(baseline, subject);
  if (!difference.empty()) refuse(baseline, difference);
}

BaselineComparison comparedToBaseline(const BudgetResult& result, const Baseline& baseline,
                                      double tolerance_percent, double work_tolerance_percent) {
  BaselineComparison comparison;
  comparison.file = baseline.file;
  comparison.tolerance_percent = tolerance_percent;
  comparison.work_tolerance_percent = work_tolerance_percent;
  comparison.other_machine = otherMachine(baseline, result.subject);
  comparison.has_work = baseline.hasWork() && (tellsOfWork(baseline) || tellsOfWork(result));
  comparison.work = workChanges(result, baseline, work_tolerance_percent);
  comparison.other_states = comparison.has_work && baseline.final_state != result.least.back().state_hash;
  for (const WorkChange& c : comparison.work)
    if (c.is_over) comparison.verdict = BudgetVerdict::kOver;
  if (!comparison.other_machine.empty()) return comparison;
  const auto add = [&](const std::string& name, const std::string& figure, double before_ms, double now_ms,
                       const std::vector<double>& replays_ms) {
    const double limit = before_ms + std::max({0.01 * tolerance_percent * before_ms, kLeastGrowth_ms,
                                               kLeastShareOfFrame * baseline.frame_mean_ms});
    comparison.changes.push_back(
        change(name, figure, before_ms, {limit, now_ms, replays_ms, result.evidence.outside_load}));
  };
  for (std::size_t p = 0; p < kFramePhases; ++p) {
    const auto timesOf = [p](const std::vector<FrameCost>& frames) { return phaseTimes_ms(frames, p); };
    add(kFramePhaseNames[p], "mean", baseline.phase_mean_ms[p], distributionOf(timesOf(result.least)).mean,
        replayMeans(result, timesOf));
  }
  add("frame", "mean", baseline.frame_mean_ms, distributionOf(totals_ms(result.least)).mean,
      replayMeans(result, totals_ms));
  if (baseline.percent == result.gate.percent)
    add("frame", percentileName(baseline.percent), baseline.at_percentile_ms, result.evidence.least_ms,
        result.evidence.replays_ms);
  for (const PhaseChange& c : comparison.changes) {
    if (c.verdict == BudgetVerdict::kOver) comparison.verdict = BudgetVerdict::kOver;
    if (c.verdict == BudgetVerdict::kInconclusive && comparison.verdict == BudgetVerdict::kWithin)
      comparison.verdict = BudgetVerdict::kInconclusive;
  }
  return comparison;
}

std::vector<std::string> baselineLines(const BaselineComparison& comparison) {
  std::vector<PhaseChange> slower;
  for (const PhaseChange& c : comparison.changes)
    if (c.verdict != BudgetVerdict::kWithin) slower.push_back(c);
  std::stable_sort(slower.begin(), slower.end(), [](const PhaseChange& x, const PhaseChange& y) {
    if ((x.name == "frame") != (y.name == "frame")) return y.name == "frame";
    return x.evidence.least_ms - x.before_ms > y.evidence.least_ms - y.before_ms;
  });
  std::vector<std::string> lines;
  for (const PhaseChange& c : slower)
    lines.push_back(changeLine(c, comparison.tolerance_percent) + workOf(comparison, c.name));
  if (!comparison.other_machine.empty())
    lines.push_back("no times were compared: " + comparison.file + " is of another " +
                    comparison.other_machine);
  else if (lines.empty())
    lines.push_back("no phase is slower than in " + comparison.file + " by more than " +
                    formatted("%.3g %%", comparison.tolerance_percent));
  addWorkLines(comparison, lines);
  return lines;
}

}  // namespace carom::demos
