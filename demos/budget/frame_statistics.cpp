#include "demos/budget/frame_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr double kRounding = 1e-9;  // relative: of 100 / (100 - 99.9) and the like

double sumOf(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::optional<double> supportedPercentile(const std::vector<double>& values, double percent) {
  if (static_cast<int>(values.size()) < framesNeeded(percent)) return std::nullopt;
  return percentile(values, percent);
}

/// The next of 1, 2, 5, 10, 20... times 10^-6 or more.
double niceWidth(double least) {
  double decade = 1e-6;
  for (int i = 0; i < 18; ++i, decade *= 10.0)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor * decade >= least) return factor * decade;
  return least;
}

}  // namespace

double percentile(std::vector<double> values, double percent) {
  REQUIRE(!values.empty() && percent > 0.0 && percent <= 100.0, values.size(), percent);
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()) * (1.0 - kRounding));
  const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

int framesNeeded(double percent) {
  REQUIRE(percent > 0.0 && percent <= 100.0, percent);
  if (percent == 100.0) return 1;
  return static_cast<int>(std::min(std::ceil(100.0 / (100.0 - percent) * (1.0 - kRounding)), 1e9));
}

Distribution distributionOf(const std::vector<double>& values) {
  REQUIRE(!values.empty());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low,
          percentile(values, 50.0),
          supportedPercentile(values, 95.0),
          supportedPercentile(values, 99.0),
          *high,
          sumOf(values) / static_cast<double>(values.size())};
}

std::optional<double> onePercentLow(std::vector<double> times_ms) {
  if (times_ms.size() < 100) return std::nullopt;
  const std::size_t slowest = times_ms.size() / 100;
  std::sort(times_ms.begin(), times_ms.end(), std::greater<>());
  times_ms.resize(slowest);
  return 1000.0 * static_cast<double>(slowest) / sumOf(times_ms);
}

Overrun overrunOf(const std::vector<double>& times_ms, double deadline_ms) {
  Overrun overrun;
  for (const double time_ms : times_ms) {
    if (!(time_ms > deadline_ms)) continue;
    ++overrun.frames;
    overrun.worst_ms = std::max(overrun.worst_ms, time_ms - deadline_ms);
    overrun.sum_ms += time_ms - deadline_ms;
  }
  return overrun;
}

std::vector<HistogramBin> histogramOf(const std::vector<double>& values, int most_bins) {
  REQUIRE(!values.empty() && most_bins >= 2, values.size(), most_bins);
  const double low = *std::min_element(values.begin(), values.end());
  const double high = *std::max_element(values.begin(), values.end());
  const double top = percentile(values, 95.0);
  double width = niceWidth((top - low) / most_bins);
  const auto first = [&] { return std::floor(low / width); };
  const auto count = [&] { return static_cast<int>(std::floor(top / width) - first()) + 1; };
  while (count() > most_bins) width = niceWidth(1.5 * width);  // the ends need not fall on the grid
  std::vector<HistogramBin> bins(static_cast<std::size_t>(count()));
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].low = (first() + static_cast<double>(i)) * width;
    bins[i].high = (first() + static_cast<double>(i) + 1.0) * width;
  }
  const std::size_t regular = bins.size();
  const double end = bins.back().high;
  if (high >= end) bins.push_back({end, std::nextafter(high, 2.0 * high), 0});
  for (const double value : values) {
    const auto bin = static_cast<std::size_t>(std::floor(value / width) - first());
    ++(value >= end ? bins.back() : bins[std::min(bin, regular - 1)]).count;
  }
  return bins;
}

}  // namespace carom::demos
