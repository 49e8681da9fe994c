#include "demos/against/sign_test.h"

#include <cmath>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

/// By adding up every binomial coefficient.
double chanceByHand(int larger, int pairs) {
  const int more = std::max(larger, pairs - larger);
  double sum = 0.0, coefficient = 1.0;
  for (int k = 0; k <= pairs; ++k) {
    if (k >= more) sum += coefficient;
    coefficient *= static_cast<double>(pairs - k) / (k + 1);
  }
  return std::min(1.0, 2.0 * sum / std::pow(2.0, pairs));
}

TEST(SignTest, ChancesAreThoseOfCountingAllOutcomes) {
  for (int pairs = 1; pairs <= 40; ++pairs)
    for (int larger = 0; larger <= pairs; ++larger)
      EXPECT_NEAR(std::exp(logSignChance(larger, pairs)), chanceByHand(larger, pairs), 1e-12)
          << larger << " of " << pairs;
}

// Tables: 20 of 20 are rarer than 1e-5, 21 of 21 rarer than 1e-6 for the first time.
TEST(SignTest, TwentyOnePairsOfOneSignAreTheFewestThatTellAtAMillionth) {
  EXPECT_EQ(fewestOf(20, 1e-6), 21);
  EXPECT_EQ(fewestOf(21, 1e-6), 21);
  EXPECT_NEAR(logSignChance(21, 21), -20.0 * std::log(2.0), 1e-9);
}

TEST(SignTest, StaysFiniteForManyPairs) {
  EXPECT_NEAR(std::exp(logSignChance(500000, 1000000)), 1.0, 1e-3);
  // The normal approximation with its half-step: 4.999 standard deviations of 500 each.
  EXPECT_NEAR(std::exp(logSignChance(502500, 1000000)), std::erfc(4.999 / std::sqrt(2.0)), 1e-10);
  EXPECT_TRUE(std::isfinite(logSignChance(1000000, 1000000)));
}

TEST(SignTest, SaysTheSmallestShiftThatItWouldHaveFound) {
  std::vector<double> differences;
  for (int i = -100; i <= 100; ++i) differences.push_back(0.001 * i);
  const SignTest test = signTest(differences, 1e-6);
  EXPECT_FALSE(test.finds(1e-6));
  const auto shifted = [&](double shift) {
    std::vector<double> moved = differences;
    for (double& d : moved) d += shift;
    return signTest(moved, 1e-6).finds(1e-6);
  };
  EXPECT_TRUE(shifted(test.smallest_effect + 1e-9));
  EXPECT_FALSE(shifted(test.smallest_effect - 0.002));
}

TEST(SignTest, OfTooFewPairsFindsNothingWhateverTheirSize) {
  const SignTest test = signTest(std::vector<double>(20, 5.0), 1e-6);
  EXPECT_FALSE(test.finds(1e-6));
  EXPECT_TRUE(std::isinf(test.smallest_effect));
}

}  // namespace
}  // namespace carom::demos
