#pragma once
// Worlds of the explorer of links that hang on one another: chains and nets of rings on a hook, with a load
// of up to a thousand links at the end. Family "hanging". They have seeds of their own, from kHangingWorlds
// on. Tested in tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld hangingWorld(std::uint64_t seed);

}  // namespace carom::explore
