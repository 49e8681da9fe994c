#pragma once
// Worlds of the explorer in which many bodies are driven by few: pressed between pistons, lids and walls,
// stirred by an arm, or guided by locked axes while they fall on each other: families "pressed", "stirred",
// "guided". They have seeds of their own, from kDrivenCrowds on. Tested in
// tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld drivenCrowd(std::uint64_t seed);

}  // namespace carom::explore
