#pragma once
// What a world asks of those who describe its bodies and its environment: numbers that are finite and in
// their ranges, and motions that agree with each other. Each function throws ContractViolation, which names
// what is wrong. Internal to the simulation floor. Tested in tests/engine/simulation/world_test.cpp.

#include <cstddef>

#include "engine/simulation/bodies/world_types.h"

namespace carom {

/// `solids`: how many the world has.
void requireDescription(const BodyDescription& d, std::size_t solids);
void requireSettings(const WorldSettings& settings);

}  // namespace carom
