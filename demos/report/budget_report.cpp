#include "demos/report/budget_report.h"

#include <algorithm>
#include <cmath>

#include "demos/format/content_hash.h"
#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

constexpr int kHistogramBins = 16;
constexpr int kBarWidth = 50;
constexpr std::size_t kSlowest = 5;

std::string headText(const BudgetResult& result) {
  const BudgetSubject& s = result.subject;
  std::string text = formatted("%s: %d frames at %g fps, %dx%d, %s, %zu replays, all ending in state %s\n",
                               s.scene.c_str(), s.frames, s.fps, s.width, s.height, s.preset.c_str(),
                               result.replays.size(), hexText(result.least.back().state_hash).c_str());
  text += s.machine + "; " + s.renderer + "; " + s.build;
  if (s.threads > 1) text += formatted("; %d threads step", s.threads);
  if (s.clock == "cpu")
    text += "; CPU time of all threads";
  else if (result.outside_load)
    text += formatted("; others used %.0f %% of the CPU", 100.0 * *result.outside_load);
  return text + "\n";
}

std::string rowText(const char* name, const std::vector<double>& times_ms, double frame_mean_ms) {
  const Distribution d = distributionOf(times_ms);
  const auto cell = [](const std::optional<double>& value) {
    return value ? formatted("%10.3f", *value) : formatted("%10s", "-");
  };
  return formatted("%-17s", name) + cell(d.min) + cell(d.p50) + cell(d.p95) + cell(d.p99) + cell(d.max) +
         formatted("%8.1f %%\n", 100.0 * d.mean / frame_mean_ms);
}

std::string tableText(const BudgetResult& result) {
  const std::vector<double> totals = totals_ms(result.least);
  const double mean = distributionOf(totals).mean;
  std::string text = formatted("%-17s%10s%10s%10s%10s%10s%10s\n", "ms a frame", "min", "p50", "p95", "p99",
                               "max", "of mean");
  for (std::size_t p = 0; p < kFramePhases; ++p)
    text += rowText(kFramePhaseNames[p], phaseTimes_ms(result.least, p), mean);
  return text + rowText("frame", totals, mean);
}

std::string figuresText(const BudgetResult& result) {
  const std::vector<double> totals = totals_ms(result.least);
  const Overrun overrun = overrunOf(totals, result.gate.budget_ms);
  std::string text =
      formatted("over %g ms: %d of %zu frames (%.1f %%)", result.gate.budget_ms, overrun.frames,
                totals.size(), 100.0 * overrun.frames / static_cast<double>(totals.size()));
  if (overrun.frames > 0)
    text += formatted(", the worst by %.1f ms, %.1f ms in all", overrun.worst_ms, overrun.sum_ms);
  text += formatted("\nfps: %.1f at the median", 1000.0 / percentile(totals, 50.0));
  if (const std::optional<double> low = onePercentLow(totals)) text += formatted(", 1 %% low %.1f", *low);
  text += formatted("\n%s of each replay, ms:", percentileName(result.gate.percent).c_str());
  for (const double replay_ms : result.evidence.replays_ms) text += formatted(" %.3g", replay_ms);
  return text + formatted(" (spread %.2f)\n", spreadOf(result.evidence.replays_ms));
}

/// Bars of the bins that hold frames; the bin of the deadline is marked.
std::string histogramText(const BudgetResult& result) {
  const std::vector<HistogramBin> bins = histogramOf(totals_ms(result.least), kHistogramBins);
  int most = 1;
  for (const HistogramBin& bin : bins) most = std::max(most, bin.count);
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(bins[0].high - bins[0].low))), 0, 6);
  std::string text = "frames by ms\n";
  bool gap = false;
  for (const HistogramBin& bin : bins) {
    const double deadline = result.gate.budget_ms;
    const bool holds_deadline = bin.low <= deadline && deadline < bin.high;
    if (bin.count == 0 && !holds_deadline) {
      if (!gap) text += "  ...\n";
      gap = true;
      continue;
    }
    gap = false;
    const int bar = (bin.count * kBarWidth + most - 1) / most;
    text += formatted("  %8.*f - %-8.*f %6d  ", digits, bin.low, digits, bin.high, bin.count) +
            std::string(static_cast<std::size_t>(bar), '#') + (holds_deadline ? "  < budget" : "") + "\n";
  }
  return text;
}

std::string slowestText(const BudgetResult& result) {
  std::string text = formatted("%-14s%10s%10s%10s%8s%9s%8s  %s\n", "slowest", "at s", "ms", "contacts",
                               "pairs", "queries", "events", "most of it");
  for (const FrameCost& f : slowestFrames(result.least, kSlowest)) {
    const auto most = std::max_element(f.phase_ms.begin(), f.phase_ms.end());
    const char* name = kFramePhaseNames[static_cast<std::size_t>(most - f.phase_ms.begin())];
    text += formatted("frame %-8d%10.3f%10.3f%10d%8d%9d%8d  %s %.3g ms\n", f.frame, f.time_s, f.total_ms,
                      f.contacts, f.pairs, f.queries, f.events, name, *most);
  }
  return text;
}

}  // namespace

std::string budgetReport(const BudgetResult& result, const BaselineComparison* comparison) {
  std::string text = headText(result) + "\n" + tableText(result) + "\n" + figuresText(result) + "\n" +
                     histogramText(result) + "\n" + slowestText(result) + "\n";
  if (comparison != nullptr)
    for (const std::string& line : baselineLines(*comparison)) text += line + "\n";
  return text + verdictLine(result) + "\n";
}

}  // namespace carom::demos
