#pragma once
// Worlds of the explorer over one floor without friction: what moves there keeps its momentum across the
// floor's normal and its angular momentum about it (watch/momentum_watch.h). Family "ice". They have seeds of
// their own, from kIceWorlds on. Tested in tests/explore/random_world_test.cpp.

#include "tests/explore/random_world.h"

namespace carom::explore {

ExploredWorld iceWorld(std::uint64_t seed);

}  // namespace carom::explore
