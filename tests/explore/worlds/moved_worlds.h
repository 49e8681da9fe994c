#pragma once
// Worlds of the explorer in which bodies are moved along paths, have locked axes and loads, or are concave
// meshes: families "kinematic", "locked", "concave". They have seeds of their own, from kMovedWorlds on, so
// that the others stay what they are. Tested in tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld movedWorld(std::uint64_t seed);

}  // namespace carom::explore
