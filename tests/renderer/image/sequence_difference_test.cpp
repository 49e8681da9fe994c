#include "renderer/image/sequence_difference.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

// The oracle: the table of longest common parts (Wagner, Fischer 1974).
std::size_t longestCommon(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<std::vector<std::size_t>> longest(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k)
      longest[i + 1][k + 1] =
          a[i] == b[k] ? longest[i][k] + 1 : std::max(longest[i + 1][k], longest[i][k + 1]);
  return longest[a.size()][b.size()];
}

std::vector<int> without(std::vector<int> values, const std::vector<std::size_t>& places) {
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(*place));
  return values;
}

std::vector<int> someOf(int count, std::mt19937& random) {
  std::vector<int> values(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = i;
  std::shuffle(values.begin(), values.end(), random);
  values.resize(random() % (values.size() + 1));
  return values;
}

TEST(SequenceDifference, WhatIsCommonIsALongestPartOfBothInOrder) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const std::vector<int> before = someOf(12, random), now = someOf(12, random);
    const SequenceDifference difference = sequenceDifference(before, now, Order::kMatters);
    const std::vector<int> common = without(before, difference.gone);
    EXPECT_EQ(common, without(now, difference.come));
    EXPECT_EQ(common.size(), longestCommon(before, now));
  }
}

TEST(SequenceDifference, RepeatedValuesAreCommonInOrderToo) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    std::vector<int> before(random() % 10), now(random() % 10);
    for (std::vector<int>* values : {&before, &now})
      for (int& value : *values) value = static_cast<int>(random() % 3);
    const SequenceDifference difference = sequenceDifference(before, now, Order::kMatters);
    EXPECT_EQ(without(before, difference.gone), without(now, difference.come));
  }
}

TEST(SequenceDifference, WithoutOrderWhatBothHoldIsCommon) {
  const SequenceDifference difference =
      sequenceDifference(std::vector{4, 1, 1, 7, 3}, std::vector{3, 1, 9, 4}, Order::kIsFree);
  EXPECT_EQ(difference.gone, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(difference.come, (std::vector<std::size_t>{2}));
}

TEST(SequenceDifference, TheSameDiffersNowhereAndNothingFromNothing) {
  const std::vector<int> values = {3, 1, 3}, none;
  EXPECT_TRUE(sequenceDifference(values, values, Order::kMatters).isEmpty());
  EXPECT_TRUE(sequenceDifference(none, none, Order::kMatters).isEmpty());
  EXPECT_EQ(sequenceDifference(none, values, Order::kMatters).come.size(), 3u);
  EXPECT_EQ(sequenceDifference(values, none, Order::kIsFree).gone.size(), 3u);
}

TEST(SequenceDifference, ZerosOfDifferentSignDiffer) {
  EXPECT_FALSE(sequenceDifference(std::vector{0.0f}, std::vector{-0.0f}, Order::kMatters).isEmpty());
}

}  // namespace
}  // namespace carom::renderer
