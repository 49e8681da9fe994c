#include "demos/budget_baseline.h"

#include <algorithm>
#include <cstdio>

#include "demos/asset_path.h"
#include "demos/json.h"
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
  char line[256];
  const double growth = c.before_ms > 0.0 ? 100.0 * (c.evidence.least_ms / c.before_ms - 1.0) : 100.0;
  std::snprintf(line, sizeof line, "%s: %s, %s %.3g ms, was %.3g ms (+%.0f %%, tolerance %.3g %%)",
                c.verdict == BudgetVerdict::kOver ? "slower" : "inconclusive", c.name.c_str(),
                c.figure.c_str(), c.evidence.least_ms, c.before_ms, growth, tolerance_percent);
  return c.verdict == BudgetVerdict::kOver ? line : line + (", but " + noiseText(c.evidence));
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
  return baseline;
}

void requireSameSubject(const Baseline& baseline, const BudgetSubject& subject) {
  const BudgetSubject& was = baseline.subject;
  const auto require = [&](const char* what, const std::string& before, const std::string& now) {
    if (before != now)
      throw InputError(baseline.file + ": is of another " + what + ": " + before + ", not " + now +
                       "; times can be compared only where all but the program is the same");
  };
  const auto size = [](const BudgetSubject& s) {
    return std::to_string(s.width) + "x" + std::to_string(s.height);
  };
  const auto length = [](const BudgetSubject& s) {
    return std::to_string(s.frames) + " frames at " + percentileName(s.fps).substr(1) + " fps";
  };
  require("scene", was.scene, subject.scene);
  require("content of the scene (file, meshes or seed)", was.scene_hash, subject.scene_hash);
  require("size", size(was), size(subject));
  require("length", length(was), length(subject));
  require("camera", was.camera, subject.camera);
  require("preset", was.preset, subject.preset);
  require("number of threads", std::to_string(was.threads), std::to_string(subject.threads));
  require("machine", was.machine, subject.machine);
  require("renderer", was.renderer, subject.renderer);
  require("build", was.build, subject.build);
}

BaselineComparison comparedToBaseline(const BudgetResult& result, const Baseline& baseline,
                                      double tolerance_percent) {
  BaselineComparison comparison{baseline.file, tolerance_percent, {}, BudgetVerdict::kWithin};
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
  for (const PhaseChange& c : slower) lines.push_back(changeLine(c, comparison.tolerance_percent));
  char tolerance[32];
  std::snprintf(tolerance, sizeof tolerance, "%.3g %%", comparison.tolerance_percent);
  if (lines.empty())
    lines.push_back(std::string("no phase is slower than in ") + comparison.file + " by more than " +
                    tolerance);
  return lines;
}

}  // namespace carom::demos
