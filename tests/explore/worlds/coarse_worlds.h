#pragma once
// Worlds of the explorer in which a step is long for what happens in it: small bodies at 10 to 30 steps a
// second, or under a hundred times the weight; one in six of them is concave. Family "coarse". They have
// seeds of their own, from kCoarseWorlds on. Tested in tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld coarseWorld(std::uint64_t seed);

}  // namespace carom::explore
