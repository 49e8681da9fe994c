// Small swings: who counts as swinging, and what it keeps of its velocity. Pendulums are cosines here; what
// they do in a world is tested in tests/physics/friction/swing_test.cpp.

#include "engine/modes/swinging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/foundation/tolerances.h"

namespace carom {
namespace {

constexpr double kStep = 1.0 / 60;
constexpr double kRadius = 0.5;
constexpr double kLargestRise = tolerance::kSwingRise * kRadius;

// What is kept after `seconds` of a swing that rises by `rise_m`.
double keptOfSwing(double rise_m, double period_s, double seconds, double radius_m = kRadius) {
  SwingWatch watch;
  for (double t = 0.0; t < seconds; t += kStep) {
    const double v = std::cos(2.0 * std::numbers::pi * t / period_s);  // in shares of the largest
    watch.follow({0.1 * v * Vec3::UnitX(), 0.2 * v * Vec3::UnitY()}, radius_m, v * v * rise_m, kStep);
  }
  return watch.keeps(kStep);
}

// To and fro along x, at a rise that is small.
void shuttle(SwingWatch& watch, double velocity) {
  watch.follow({velocity * Vec3::UnitX(), Vec3::Zero()}, kRadius, 1e-3 * kLargestRise, kStep);
}

TEST(SwingWatch, KeepsAllUntilItHasTurnedRoundTwice) {
  const double rise = 0.1 * kLargestRise;
  EXPECT_EQ(keptOfSwing(rise, 2.0, 0.4), 1.0);
  EXPECT_EQ(keptOfSwing(rise, 2.0, 1.4), 1.0) << "once could be a blow";
  EXPECT_LT(keptOfSwing(rise, 2.0, 1.6), 1.0);
}

TEST(SwingWatch, KeepsLessTheSmallerTheSwing) {
  // At 2 s the cosine is at its peak again.
  const double small = keptOfSwing(1e-4 * kLargestRise, 2.0, 2.0);
  const double half = keptOfSwing(0.5 * kLargestRise, 2.0, 2.0);
  const double nearly = keptOfSwing(0.999 * kLargestRise, 2.0, 2.0);
  EXPECT_LT(small, half);
  EXPECT_LT(half, nearly);
  EXPECT_NEAR(small, 1.0 / (1.0 + std::numbers::pi / 1.0 * kStep), 1e-3) << "half of critical damping";
  EXPECT_NEAR(nearly, 1.0, 1e-3) << "as the swings that are too large to count";
  EXPECT_EQ(keptOfSwing(1.01 * kLargestRise, 2.0, 2.0), 1.0);
}

TEST(SwingWatch, WhatIsSmallGoesByTheRadius) {
  const double rise = 0.8 * kLargestRise;
  EXPECT_LT(keptOfSwing(rise, 2.0, 2.2), 1.0);
  EXPECT_EQ(keptOfSwing(rise, 2.0, 2.2, 0.5 * kRadius), 1.0);
}

TEST(SwingWatch, QuickSwingsAreSlowedAsByDryFriction) {
  const auto slowed =
      [](double relative_amplitude) {  // in speed, a step: shares of the largest that is small
        return std::sqrt(relative_amplitude) *
               (1.0 / keptOfSwing(relative_amplitude * kLargestRise, 0.2, 2.0) - 1.0);
      };
  const double friction = tolerance::kSwingDamping * kStep;
  EXPECT_NEAR(slowed(0.02), 0.98 * friction, 1e-9);
  EXPECT_NEAR(slowed(0.1), 0.9 * friction, 1e-9);
  EXPECT_NEAR(slowed(1e-6), 1e-3 * std::numbers::pi / 0.1 * kStep, 1e-5) << "half of critical damping";
}

TEST(SwingWatch, WhatGoesOnOneWayIsLetGo) {
  SwingWatch watch;
  for (int i = 0; i < 1000; ++i) {
    shuttle(watch, 0.1);
    ASSERT_EQ(watch.keeps(kStep), 1.0) << "never turned round";
  }
  for (int half = 0; half < 4; ++half)
    for (int i = 0; i < 10; ++i) shuttle(watch, half % 2 == 0 ? -0.1 : 0.1);
  EXPECT_LT(watch.keeps(kStep), 1.0) << "it swings";
  for (int i = 0; i < 15; ++i) shuttle(watch, 0.1);
  EXPECT_EQ(watch.keeps(kStep), 1.0) << "for longer than two of its half swings it has not turned";
}

TEST(SwingWatch, ForgetsWhenTold) {
  SwingWatch watch;
  for (int i = 0; i < 10; ++i) shuttle(watch, i % 2 == 0 ? 0.1 : -0.1);
  EXPECT_LT(watch.keeps(kStep), 1.0);
  watch.forget();
  EXPECT_EQ(watch.keeps(kStep), 1.0);
}

TEST(SwingWatch, WithoutGravityNothingSwings) {
  SwingWatch watch;
  const double rise_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10; ++i)
    watch.follow({(i % 2 == 0 ? 0.1 : -0.1) * Vec3::UnitX(), Vec3::Zero()}, kRadius, rise_m, kStep);
  EXPECT_EQ(watch.keeps(kStep), 1.0);
}

}  // namespace
}  // namespace carom
