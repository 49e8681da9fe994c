#include "engine/foundation/stack_arena.h"

#include <gtest/gtest.h>

#include <vector>

namespace carom {
namespace {

TEST(StackArena, AVectorThatFits_LiesInTheArena) {
  StackArena<1024> arena;
  ArenaVector<int> numbers(200, 7, &arena);
  const auto* begin = reinterpret_cast<const std::byte*>(&arena);
  const auto* place = reinterpret_cast<const std::byte*>(numbers.data());
  EXPECT_GE(place, begin);
  EXPECT_LE(place + 200 * sizeof(int), begin + sizeof(arena));
}

TEST(StackArena, WhatOutgrowsIt_GoesOnInTheHeapAndKeepsItsContent) {
  StackArena<256> arena;
  ArenaVector<double> numbers(&arena);
  for (int i = 0; i < 1000; ++i) numbers.push_back(i);
  const auto* begin = reinterpret_cast<const std::byte*>(&arena);
  const auto* place = reinterpret_cast<const std::byte*>(numbers.data());
  EXPECT_TRUE(place < begin || place >= begin + sizeof(arena));
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(numbers[static_cast<std::size_t>(i)], i);
}

TEST(StackArena, VectorsOfSeveralTypes_AreAligned) {
  StackArena<1024> arena;
  const ArenaVector<char> odd(3, 'x', &arena);
  const ArenaVector<double> wide(3, 1.0, &arena);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(wide.data()) % alignof(double), 0u);
}

}  // namespace
}  // namespace carom
