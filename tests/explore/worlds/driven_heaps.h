#pragma once
// Worlds of the explorer in which many bodies are driven by few: pressed between pistons, lids and walls,
// mixed by an arm, or guided by locked axes while they fall on each other: families "pressed", "mixed",
// "guided". They have seeds of their own, from kDrivenHeaps on. Tested in
// tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld drivenHeap(std::uint64_t seed);

}  // namespace carom::explore
