#include "demos/budget/budget_result.h"

#include <algorithm>
#include <cmath>

#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

/// Three digits that count.
std::string ms(double value) {
  return formatted(value < 10.0 ? "%.3g ms" : value < 100.0 ? "%.1f ms" : "%.0f ms", value);
}

}  // namespace

std::string percentileName(double percent) {
  return formatted("p%.10g", percent);
}

BudgetResult judged(const BudgetSubject& subject, const BudgetGate& gate, std::vector<Replay> replays,
                    std::optional<double> outside_load) {
  requireSameStates(replays);
  BudgetResult result{subject, gate, std::move(replays), outside_load, {}, {}, {}};
  result.least = leastCosts(result.replays);
  result.evidence.limit_ms = gate.budget_ms;
  result.evidence.least_ms = percentile(totals_ms(result.least), gate.percent);
  for (const Replay& replay : result.replays)
    result.evidence.replays_ms.push_back(percentile(totals_ms(replay.frames), gate.percent));
  result.evidence.outside_load = outside_load.value_or(0.0);
  result.verdict = verdictOf(result.evidence);
  return result;
}

std::string noiseText(const TimeEvidence& evidence) {
  std::string noise;
  const double spread = spreadOf(evidence.replays_ms);
  if (spread > kReplaysAgree) noise = "the replays differ by a factor of " + formatted("%.2g", spread);
  if (evidence.outside_load > kQuietLoad)
    noise += (noise.empty() ? "" : " and ") +
             ("others used " + formatted("%.0f %% of the CPU", 100.0 * evidence.outside_load));
  return noise;
}

std::string verdictLine(const BudgetResult& result) {
  const TimeEvidence& e = result.evidence;
  const std::string figures = std::string(verdictName(result.verdict)) + ": " +
                              percentileName(result.gate.percent) + " " + ms(e.least_ms) + ", budget " +
                              ms(e.limit_ms);
  const double difference = std::abs(e.least_ms - e.limit_ms);
  const std::string share = ms(difference) + formatted(" (%.0f %%)", 100.0 * difference / e.limit_ms);
  if (result.verdict == BudgetVerdict::kWithin) return figures + ", " + share + " to spare";
  if (result.verdict == BudgetVerdict::kOver) return figures + ", " + share + " too slow";
  if (e.least_ms <= e.limit_ms)
    return figures + ", but no replay by itself came below " +
           ms(*std::min_element(e.replays_ms.begin(), e.replays_ms.end())) + "; try a quieter machine";
  return figures + ", but " + noiseText(e) + ": a no would take more than " +
         ms(noiseAllowance(e) * e.limit_ms) + "; try a quieter machine";
}

}  // namespace carom::demos
