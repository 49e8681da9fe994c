#include "demos/budget/budget_verdict.h"

#include <algorithm>

namespace carom::demos {

const char* verdictName(BudgetVerdict verdict) {
  switch (verdict) {
    case BudgetVerdict::kWithin:
      return "within";
    case BudgetVerdict::kOver:
      return "over";
    case BudgetVerdict::kInconclusive:
      return "inconclusive";
  }
  return "?";
}

double spreadOf(const std::vector<double>& replays_ms) {
  if (replays_ms.empty()) return 1.0;
  const auto [low, high] = std::minmax_element(replays_ms.begin(), replays_ms.end());
  return *low > 0.0 ? *high / *low : 1.0;
}

// A share f of the CPU in other hands leaves 1 - f: times are 1 / (1 - f) as long on average, and the slow
// frames, which also wait for their turn, by as much again. Measured on two cores, for the 99th percentile:
// 2.2 times with a share of 0.44, 6.5 with 0.83, 8.7 with 0.87.
double noiseAllowance(const TimeEvidence& evidence) {
  constexpr double kLargestLoad = 0.99;
  double allowance = 1.0;
  const double spread = spreadOf(evidence.replays_ms);
  if (spread > kReplaysAgree) allowance *= spread;
  if (evidence.outside_load > kQuietLoad) {
    const double left = 1.0 - std::min(evidence.outside_load, kLargestLoad);
    allowance *= kReplaysAgree / (left * left);
  }
  return allowance;
}

BudgetVerdict verdictOf(const TimeEvidence& evidence) {
  if (evidence.least_ms <= evidence.limit_ms) {
    const std::vector<double>& replays = evidence.replays_ms;
    const bool near = replays.empty() ||
                      *std::min_element(replays.begin(), replays.end()) <= kReplaysAgree * evidence.limit_ms;
    return near ? BudgetVerdict::kWithin : BudgetVerdict::kInconclusive;
  }
  return evidence.least_ms > noiseAllowance(evidence) * evidence.limit_ms ? BudgetVerdict::kOver
                                                                          : BudgetVerdict::kInconclusive;
}

}  // namespace carom::demos
