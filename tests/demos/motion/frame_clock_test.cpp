#include "demos/motion/frame_clock.h"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

/// Steps of 1/240, 0.002, 0.005, 0.01 s against 24, 30, 60 frames a second. Rates are whole here, so
/// whole-number arithmetic is the oracle: step = k * rate div fps, fraction = k * rate mod fps / fps.
class FrameClockExactness : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(FrameClockExactness, FrameShowsExactlyKOverFps) {
  const auto [rate, fps] = GetParam();
  const FrameClock clock({static_cast<double>(fps), static_cast<double>(rate)});
  for (int k = 0; k <= 100000; k += k < 1000 ? 1 : 997) {
    const StepInstant instant = clock.instant(k);
    const long long numerator = static_cast<long long>(k) * rate;
    ASSERT_EQ(instant.step, numerator / fps) << k;
    ASSERT_EQ(instant.fraction, static_cast<double>(numerator % fps) / fps) << k;
    ASSERT_EQ(clock.time(k), static_cast<double>(k) / fps) << k;
    ASSERT_EQ(instant.lastStepNeeded(), (numerator + fps - 1) / fps) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(StepsAndRates, FrameClockExactness,
                         testing::Combine(testing::Values(240, 500, 200, 100), testing::Values(24, 30, 60)));

TEST(FrameClock, HoldsRoundedDurationTimesFpsFrames) {
  EXPECT_EQ(FrameClock({60.0, 240.0}).frameCount(5.0), 300);  // not 301
  EXPECT_EQ(FrameClock({30.0, 240.0}).frameCount(0.1), 3);
  EXPECT_EQ(FrameClock({24.0, 240.0}).frameCount(0.99), 24);
  EXPECT_EQ(FrameClock({30.0, 500.0}).stepCount(0.1), 50);
}

TEST(FrameClock, KeepsABrokenFrameRateWithinRounding) {
  const FrameClock clock({29.97, 240.0});
  for (int k = 0; k < 10000; ++k) {
    const StepInstant instant = clock.instant(k);
    EXPECT_GE(instant.fraction, 0.0);
    EXPECT_LT(instant.fraction, 1.0);
    // step and fraction are each rounded once: 2 ulp of the step count.
    EXPECT_NEAR(instant.step + instant.fraction, k * 240.0 / 29.97, 2.0 * 8e4 * 2.3e-16);
  }
}

TEST(FrameClock, AStillIsOneFrameAtExactlyItsTime) {
  const FrameClock clock = FrameClock::still(0.29, 100.0);
  EXPECT_EQ(clock.frameCount(5.0), 1);
  EXPECT_EQ(clock.time(0), 0.29);
  EXPECT_EQ(clock.instant(0).step, 29);  // 0.29 x 100 rounds to below 29, but that is what is meant
  EXPECT_EQ(clock.instant(0).fraction, 0.0);
  const StepInstant between = FrameClock::still(1.2345, 240.0).instant(0);
  EXPECT_EQ(between.step, 296);
  EXPECT_NEAR(between.fraction, 0.28, 1e-9);
  EXPECT_EQ(FrameClock::still(0.0, 240.0).instant(0).lastStepNeeded(), 0);
}

}  // namespace
}  // namespace carom::demos
