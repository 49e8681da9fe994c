#include "demos/against/signed_rank.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

double rankSum(const std::vector<double>& differences, unsigned positive) {
  double sum = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    if ((positive >> i & 1U) == 0U) continue;
    double below = 0.0, equal = 0.0;
    for (const double other : differences) {
      below += std::abs(other) < std::abs(differences[i]) ? 1.0 : 0.0;
      equal += std::abs(other) == std::abs(differences[i]) ? 1.0 : 0.0;
    }
    sum += below + 0.5 * (equal + 1.0);
  }
  return sum;
}

/// By trying every choice of signs.
double chanceByHand(const std::vector<double>& differences) {
  const auto count = static_cast<unsigned>(differences.size());
  unsigned now = 0;
  for (unsigned i = 0; i < count; ++i) now |= differences[i] > 0.0 ? 1U << i : 0U;
  const double all = rankSum(differences, (1U << count) - 1U), mine = rankSum(differences, now);
  const double more = std::max(mine, all - mine);
  unsigned rare = 0;
  for (unsigned signs = 0; signs < 1U << count; ++signs) rare += rankSum(differences, signs) >= more ? 1 : 0;
  return std::min(1.0, 2.0 * rare / std::ldexp(1.0, static_cast<int>(count)));
}

TEST(SignedRank, ChancesAreThoseOfTryingAllSigns) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<double> differences(1 + random() % 10);
    // Few sizes, so that many are equal.
    for (double& d : differences)
      d = (random() % 2 == 0 ? 1.0 : -1.0) * (1.0 + static_cast<double>(random() % 6));
    EXPECT_NEAR(std::exp(signedRankTest(differences, 1e-6).log_chance), chanceByHand(differences), 1e-12);
  }
}

// Tables of the signed-rank test (Conover, table A12): of 20 differences without ties, negative ranks that
// add up to 52 or less are rarer than 2.5 %, to 60 or less rarer than 5 %.
TEST(SignedRank, AgreesWithTheTableForTwenty) {
  const auto chanceOf = [](int negative_sum) {
    std::vector<double> differences;
    for (int rank = 20; rank >= 1; --rank) {
      const bool negative = rank <= negative_sum;
      if (negative) negative_sum -= rank;
      differences.push_back(negative ? -rank : rank);
    }
    return std::exp(signedRankTest(differences, 1e-6).log_chance) / 2.0;
  };
  EXPECT_LT(chanceOf(52), 0.025);
  EXPECT_GT(chanceOf(53), 0.025);
  EXPECT_LT(chanceOf(60), 0.05);
  EXPECT_GT(chanceOf(61), 0.05);
}

TEST(SignedRank, SaysTheSmallestShiftThatItWouldHaveFound) {
  std::vector<double> differences;
  for (int i = -30; i <= 30; ++i) differences.push_back(0.001 * i);
  const SignedRankTest test = signedRankTest(differences, 1e-6);
  EXPECT_FALSE(test.finds(1e-6));
  const auto shifted = [&](double shift) {
    std::vector<double> moved = differences;
    for (double& d : moved) d += shift;
    return signedRankTest(moved, 1e-6).finds(1e-6);
  };
  EXPECT_TRUE(shifted(test.smallest_effect + 1e-9));
  EXPECT_FALSE(shifted(test.smallest_effect - 0.001));
}

TEST(SignedRank, OfTooFewFindsNothingWhateverTheirSizeAndOfNoneNothing) {
  const SignedRankTest few = signedRankTest(std::vector<double>(20, 5.0), 1e-6);
  EXPECT_FALSE(few.finds(1e-6));
  EXPECT_TRUE(std::isinf(few.smallest_effect));
  EXPECT_TRUE(signedRankTest(std::vector<double>(21, 5.0), 1e-6).finds(1e-6));
  EXPECT_EQ(signedRankTest({}, 1e-6).log_chance, 0.0);
  EXPECT_EQ(signedRankTest({0.0, 0.0}, 1e-6).log_chance, 0.0);
}

}  // namespace
}  // namespace carom::demos
