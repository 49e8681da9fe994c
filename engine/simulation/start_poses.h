#pragma once
// What a world makes of the poses it is given: bodies that overlap are reported, bodies that touch are moved
// apart by the floor of the collision window, upwards. Internal to the simulation floor. Tested in
// tests/engine/simulation/start_test.cpp.

#include <vector>

#include "engine/simulation/pair_table.h"

namespace carom {

/// Overlapping pairs, deepest first; empty when every pair of the table was brought to the window's floor.
std::vector<Overlap> separateTouching(std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                                      PairTable& table, const Vec3& gravity);

}  // namespace carom
