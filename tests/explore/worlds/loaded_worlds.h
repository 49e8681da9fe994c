#pragma once
// Worlds of the explorer in which constant forces and torques press bodies together that nothing else holds,
// so that what they do to each other must cancel: family "loaded". They have seeds of their own, from
// kLoadedWorlds on. Tested in tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld loadedWorld(std::uint64_t seed);

}  // namespace carom::explore
