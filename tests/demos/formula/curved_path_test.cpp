#include "demos/formula/curved_path.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

TEST(CurvedPath, GoesThroughItsPointsAtOneSpeed) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0.2, 0}, {4, 3, 1}, {4, 6, -1}, {3.5, 6.2, -1}};
  const CurvedPath path(points);
  EXPECT_EQ((path.at(0.0) - points.front()).norm(), 0.0);
  EXPECT_LT((path.at(1.0) - points.back()).norm(), 1e-9);
  for (const Vec3& p : points) {
    double nearest = 1e9;
    for (int i = 0; i <= 20000; ++i) nearest = std::min(nearest, (path.at(i / 20000.0) - p).norm());
    EXPECT_LT(nearest, path.length_m() / 20000.0);
  }
  for (int i = 0; i < 400; ++i)
    EXPECT_NEAR((path.at((i + 1) / 400.0) - path.at(i / 400.0)).norm(), path.length_m() / 400.0,
                2e-3 * path.length_m() / 400.0)
        << i;
}

TEST(CurvedPath, IsStraightThroughPointsOnALineAndAsLongAsACircleRoundOne) {
  const CurvedPath line({{0, 0, 0}, {1, 1, 1}, {5, 5, 5}});
  EXPECT_NEAR(line.length_m(), 5.0 * std::sqrt(3.0), 1e-9);
  // Between two of the 256 samples of a piece its speed is taken to be constant.
  EXPECT_LT((line.at(0.5) - Vec3(2.5, 2.5, 2.5)).norm(), line.length_m() / (256.0 * 256.0));
  std::vector<Vec3> round;
  for (int k = 0; k <= 64; ++k) {
    const double a = 2.0 * std::numbers::pi * k / 64.0;
    round.emplace_back(std::cos(a), std::sin(a), 0.0);
  }
  EXPECT_NEAR(CurvedPath(round).length_m(), 2.0 * std::numbers::pi, 1e-3);
}

TEST(MonotoneCubic, IsExactAtKeyframesAndNeverBeyondThemAndStandsBetweenEqualOnes) {
  const std::array<double, 5> times = {0.5, 1.0, 3.0, 4.0, 7.0}, values = {2.0, 5.0, 5.0, -1.0, -1.5};
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_EQ(monotoneAt(times, values, times[k]), values[k]);
    EXPECT_EQ(linearAt(times, values, times[k]), values[k]);
  }
  EXPECT_EQ(monotoneAt(times, values, 0.0), 2.0);
  EXPECT_EQ(monotoneAt(times, values, 9.0), -1.5);
  EXPECT_EQ(monotoneAt(times, values, 2.2), 5.0);
  EXPECT_DOUBLE_EQ(linearAt(times, values, 3.25), 3.5);
  for (std::size_t k = 0; k + 1 < times.size(); ++k)
    for (double s = 0.0; s <= 1.0; s += 0.01) {
      const double x = monotoneAt(times, values, times[k] + s * (times[k + 1] - times[k]));
      EXPECT_GE(x, std::min(values[k], values[k + 1]) - 1e-12);
      EXPECT_LE(x, std::max(values[k], values[k + 1]) + 1e-12);
    }
}

TEST(MonotoneCubic, HasOneSlopeOnBothSidesOfAKeyframeAndNoneAtTheEnds) {
  const std::array<double, 4> times = {0.0, 1.0, 1.5, 4.0}, values = {0.0, 1.0, 3.0, 4.0};
  constexpr double h = 1e-6;
  for (const double t : {1.0, 1.5})
    EXPECT_NEAR((monotoneAt(times, values, t + h) - monotoneAt(times, values, t)) / h,
                (monotoneAt(times, values, t) - monotoneAt(times, values, t - h)) / h, 1e-4);
  EXPECT_NEAR(monotoneAt(times, values, h) / h, 0.0, 1e-4);
}

TEST(EasedShare, RestsAtBothEnds) {
  EXPECT_EQ(easedShare(-1.0), 0.0);
  EXPECT_EQ(easedShare(0.5), 0.5);
  EXPECT_EQ(easedShare(2.0), 1.0);
  EXPECT_LT(easedShare(0.01), 0.001);
}

}  // namespace
}  // namespace carom::demos
