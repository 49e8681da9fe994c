#include "demos/budget/frame_statistics.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

/// 1, 2, ..., n in an order that is not sorted.
std::vector<double> shuffledUpTo(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  std::shuffle(values.begin(), values.end(), std::mt19937(7));
  return values;
}

TEST(FrameStatistics, PercentileOfOneToNIsTheNearestRank) {
  for (const int n : {100, 200, 1000})
    for (const double percent : {1.0, 50.0, 90.0, 95.0, 99.0, 100.0})
      EXPECT_EQ(percentile(shuffledUpTo(n), percent), percent / 100.0 * n) << n << ' ' << percent;
  EXPECT_EQ(percentile(shuffledUpTo(1000), 99.9), 999.0);
  EXPECT_EQ(percentile(shuffledUpTo(7), 50.0), 4.0);
  EXPECT_EQ(percentile({3.5}, 1.0), 3.5);
}

TEST(FrameStatistics, APercentileIsTheLeastValueThatItsShareDoesNotExceed) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(1 + random() % 300);
    for (double& value : values) value = static_cast<double>(random() % 50);
    const double percent = 0.5 + static_cast<double>(random() % 199) / 2.0;
    const double p = percentile(values, percent);
    const auto n = static_cast<double>(values.size());
    const auto atMost = [&](double x) {
      return 100.0 *
             static_cast<double>(
                 std::count_if(values.begin(), values.end(), [x](double v) { return v <= x; })) /
             n;
    };
    EXPECT_GE(atMost(p), percent - 1e-6);
    EXPECT_LT(atMost(p - 0.5), percent);
  }
}

TEST(FrameStatistics, APercentileNeedsAFrameAboveIt) {
  EXPECT_EQ(framesNeeded(50.0), 2);
  EXPECT_EQ(framesNeeded(90.0), 10);
  EXPECT_EQ(framesNeeded(95.0), 20);
  EXPECT_EQ(framesNeeded(99.0), 100);
  EXPECT_EQ(framesNeeded(99.9), 1000);
  EXPECT_EQ(framesNeeded(99.99), 10000);
  EXPECT_EQ(framesNeeded(100.0), 1);
  for (const double percent : {50.0, 75.0, 90.0, 95.0, 98.0, 99.0, 99.5, 99.9}) {
    const int n = framesNeeded(percent);
    EXPECT_LT(percentile(shuffledUpTo(n), percent), n) << percent;
    EXPECT_EQ(percentile(shuffledUpTo(n - 1), percent), n - 1) << percent;
  }
}

TEST(FrameStatistics, ADistributionLeavesOutWhatItsFramesCannotSupport) {
  const Distribution full = distributionOf(shuffledUpTo(100));
  EXPECT_EQ(full.min, 1.0);
  EXPECT_EQ(full.p50, 50.0);
  EXPECT_EQ(full.p95, 95.0);
  EXPECT_EQ(full.p99, 99.0);
  EXPECT_EQ(full.max, 100.0);
  EXPECT_DOUBLE_EQ(full.mean, 50.5);
  EXPECT_FALSE(distributionOf(shuffledUpTo(99)).p99);
  EXPECT_TRUE(distributionOf(shuffledUpTo(20)).p95);
  EXPECT_FALSE(distributionOf(shuffledUpTo(19)).p95);
}

TEST(FrameStatistics, OnePercentLowIsTheRateOverTheSlowestHundredth) {
  std::vector<double> times(300, 10.0);
  times[5] = 40.0;
  times[150] = 50.0;
  times[299] = 60.0;  // the three slowest: 50 ms in the mean
  EXPECT_DOUBLE_EQ(onePercentLow(times).value(), 20.0);
  EXPECT_DOUBLE_EQ(onePercentLow(std::vector<double>(100, 8.0)).value(), 125.0);
  EXPECT_FALSE(onePercentLow(std::vector<double>(99, 8.0)));
}

TEST(FrameStatistics, OverrunCountsOnlyWhatIsBeyondTheDeadline) {
  const Overrun overrun = overrunOf({16.0, 17.0, 20.0, 16.5}, 16.5);
  EXPECT_EQ(overrun.frames, 2);
  EXPECT_DOUBLE_EQ(overrun.worst_ms, 3.5);
  EXPECT_DOUBLE_EQ(overrun.sum_ms, 4.0);
  EXPECT_EQ(overrunOf({16.0}, 16.0).frames, 0);
}

TEST(FrameStatistics, AHistogramHoldsEveryFrameInItsBin) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(1 + random() % 400);
    const double scale = std::exp2(static_cast<double>(random() % 20) - 10.0);
    for (double& value : values) value = scale * std::uniform_real_distribution<>(0.0, 1.0)(random);
    if (trial % 3 == 0) values.back() = 40.0 * scale;
    const std::vector<HistogramBin> bins = histogramOf(values, 12);
    EXPECT_LE(bins.size(), 13u);
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (i > 0) {
        EXPECT_EQ(bins[i].low, bins[i - 1].high);
      }
      const auto inside = std::count_if(values.begin(), values.end(), [&](double v) {
        return v >= bins[i].low * (1.0 - 1e-12) && v < bins[i].high;
      });
      EXPECT_EQ(bins[i].count, inside) << trial << ' ' << i;
    }
    EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), 0,
                              [](int sum, const HistogramBin& bin) { return sum + bin.count; }),
              static_cast<int>(values.size()));
  }
}

TEST(FrameStatistics, EqualFramesAndNoTimeAtAllHaveAHistogramToo) {
  EXPECT_EQ(histogramOf(std::vector<double>(5, 3.0), 12).back().count, 5);
  EXPECT_EQ(histogramOf(std::vector<double>(5, 0.0), 12).back().count, 5);
}

}  // namespace
}  // namespace carom::demos
