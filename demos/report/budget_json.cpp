#include "demos/report/budget_json.h"

#include <algorithm>
#include <sstream>

#include "demos/format/content_hash.h"

namespace carom::demos {
namespace {

Json orNull(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json distributionJson(const char* name, const std::vector<double>& times_ms, double percent) {
  const Distribution d = distributionOf(times_ms);
  return Json::object({{"name", name},
                       {"min", d.min},
                       {"p50", d.p50},
                       {"p95", orNull(d.p95)},
                       {"p99", orNull(d.p99)},
                       {"max", d.max},
                       {"mean", d.mean},
                       {"atPercentile", percentile(times_ms, percent)}});
}

Json subjectJson(const BudgetSubject& s) {
  return Json::object({{"scene", s.scene},
                       {"sceneHash", s.scene_hash},
                       {"width", s.width},
                       {"height", s.height},
                       {"fps", s.fps},
                       {"frames", s.frames},
                       {"camera", s.camera},
                       {"preset", s.preset},
                       {"threads", s.threads},
                       {"machine", s.machine},
                       {"renderer", s.renderer},
                       {"build", s.build},
                       {"clock", s.clock}});
}

Json overrunJson(const BudgetResult& result) {
  const Overrun o = overrunOf(totals_ms(result.least), result.gate.budget_ms);
  return Json::object({{"frames", o.frames}, {"worst_ms", o.worst_ms}, {"sum_ms", o.sum_ms}});
}

Json replaysJson(const BudgetResult& result) {
  Json replays = Json::array();
  for (std::size_t r = 0; r < result.replays.size(); ++r)
    replays.push(Json::object({{"atPercentile", result.evidence.replays_ms[r]},
                               {"mean", distributionOf(totals_ms(result.replays[r].frames)).mean}}));
  return replays;
}

Json slowestJson(const BudgetResult& result) {
  Json slowest = Json::array();
  for (const FrameCost& f : slowestFrames(result.least, 10))
    slowest.push(Json::object({{"frame", f.frame},
                               {"time_s", f.time_s},
                               {"ms", f.total_ms},
                               {"contacts", f.contacts},
                               {"pairs", f.pairs},
                               {"queries", f.queries},
                               {"events", f.events}}));
  return slowest;
}

Json timesJson(const std::vector<double>& times_ms) {
  Json json = Json::array();
  for (const double time_ms : times_ms) json.push(time_ms);
  return json;
}

Json workJson(const std::vector<FrameCost>& frames) {
  Json work = Json::array();
  for (std::size_t w = 0; w < kWorkKinds; ++w) {
    double sum = 0.0;
    Json counts = Json::array();
    for (const FrameCost& f : frames) {
      sum += static_cast<double>(f.work[w]);
      counts.push(static_cast<double>(f.work[w]));
    }
    work.push(Json::object({{"name", kWork[w].name},
                            {"phase", kFramePhaseNames[static_cast<std::size_t>(kWork[w].phase)]},
                            {"sum", sum},
                            {"frames", std::move(counts)}}));
  }
  return work;
}

Json workChangesJson(const BaselineComparison& comparison) {
  Json changes = Json::array();
  for (const WorkChange& c : comparison.work)
    changes.push(Json::object({{"name", kWork[c.kind].name},
                               {"before", static_cast<double>(c.before)},
                               {"now", static_cast<double>(c.now)},
                               {"firstFrame", c.first_frame},
                               {"verdict", c.is_over ? "over" : "within"}}));
  return changes;
}

Json comparisonJson(const BaselineComparison& comparison) {
  Json changes = Json::array();
  for (const PhaseChange& c : comparison.changes)
    changes.push(Json::object({{"name", c.name},
                               {"figure", c.figure},
                               {"before_ms", c.before_ms},
                               {"now_ms", c.evidence.least_ms},
                               {"verdict", verdictName(c.verdict)}}));
  return Json::object({{"file", comparison.file},
                       {"tolerance_percent", comparison.tolerance_percent},
                       {"verdict", verdictName(comparison.verdict)},
                       {"timesCompared", comparison.other_machine.empty()},
                       {"changes", std::move(changes)},
                       {"workTolerance_percent", comparison.work_tolerance_percent},
                       {"work", workChangesJson(comparison)}});
}

}  // namespace

Json budgetJson(const BudgetResult& result, const BaselineComparison* comparison) {
  const double percent = result.gate.percent;
  const std::vector<double> totals = totals_ms(result.least);
  Json phases = Json::array();
  for (std::size_t p = 0; p < kFramePhases; ++p)
    phases.push(distributionJson(kFramePhaseNames[p], phaseTimes_ms(result.least, p), percent));
  Json json = Json::object({{"format", 1},
                            {"verdict", verdictName(result.verdict)},
                            {"verdictLine", verdictLine(result)},
                            {"subject", subjectJson(result.subject)},
                            {"budget_ms", result.gate.budget_ms},
                            {"percentile", percent},
                            {"frame_ms", distributionJson("frame", totals, percent)},
                            {"phases_ms", std::move(phases)},
                            {"overrun", overrunJson(result)},
                            {"fpsMedian", 1000.0 / percentile(totals, 50.0)},
                            {"fpsOnePercentLow", orNull(onePercentLow(totals))},
                            {"replays", replaysJson(result)},
                            {"replaySpread", spreadOf(result.evidence.replays_ms)},
                            {"outsideLoad", orNull(result.outside_load)},
                            {"slowest", slowestJson(result)},
                            {"work", workJson(result.least)},
                            {"frameTimes_ms", timesJson(totals)},
                            {"finalState", hexText(result.least.back().state_hash)}});
  if (comparison != nullptr) json.set("baseline", comparisonJson(*comparison));
  return json;
}

std::string budgetCsv(const BudgetResult& result) {
  std::ostringstream csv;
  csv.precision(17);
  csv << "frame,time_s,frame_ms";
  for (const std::string name : kFramePhaseNames) {
    std::string column = name;
    std::replace(column.begin(), column.end(), ' ', '_');
    csv << ',' << column << "_ms";
  }
  csv << ",over_ms,contacts,pairs,queries,events,state\n";
  for (const FrameCost& f : result.least) {
    csv << f.frame << ',' << f.time_s << ',' << f.total_ms;
    for (const double phase_ms : f.phase_ms) csv << ',' << phase_ms;
    csv << ',' << std::max(f.total_ms - result.gate.budget_ms, 0.0) << ',' << f.contacts << ',' << f.pairs
        << ',' << f.queries << ',' << f.events << ',' << hexText(f.state_hash) << '\n';
  }
  return csv.str();
}

}  // namespace carom::demos
