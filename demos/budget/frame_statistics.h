#pragma once
// Statistics of frame times as pure functions. Percentiles are nearest-rank: the smallest of the values that
// at least P percent of all do not exceed, so each is the time of a frame that was really measured. Tested in
// tests/demos/budget/frame_statistics_test.cpp.

#include <optional>
#include <vector>

namespace carom::demos {

/// `percent` in (0, 100]; 100 is the largest. There must be a value.
double percentile(std::vector<double> values, double percent);

/// From how many frames a percentile leaves at least one frame above it: 100 for the 99th. 1 for the 100th.
int framesNeeded(double percent);

/// p95 and p99 are missing where the frames are too few.
struct Distribution {
  double min = 0.0;
  double p50 = 0.0;
  std::optional<double> p95;
  std::optional<double> p99;
  double max = 0.0;
  double mean = 0.0;
};
Distribution distributionOf(const std::vector<double>& values);

/// Frames a second over the slowest hundredth of the frames (their mean time); nothing below 100 frames.
std::optional<double> onePercentLow(std::vector<double> times_ms);

struct Overrun {
  int frames = 0;  ///< That took longer than the deadline.
  double worst_ms = 0.0;
  double sum_ms = 0.0;
};
Overrun overrunOf(const std::vector<double>& times_ms, double deadline_ms);

struct HistogramBin {
  double low = 0.0;
  double high = 0.0;  ///< Not part of the bin.
  int count = 0;
};
/// Bins of one width, 1, 2 or 5 times a power of ten, at most `most_bins` of them, up to the 95th percentile;
/// then one more, wider, that holds what is beyond, where there is something.
std::vector<HistogramBin> histogramOf(const std::vector<double>& values, int most_bins);

}  // namespace carom::demos
