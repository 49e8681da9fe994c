#pragma once
// What a world makes of the poses it is given: bodies that overlap are reported; gaps that lasting contact
// would have to open, down to bodies that touch, are opened to the rest gap by the least displacements that
// do it (least_displacements.h), whatever the order of the bodies, along their free axes. What has its gaps
// is left as it is, to the bit. Internal to the simulation floor. Tested in
// tests/engine/simulation/start_test.cpp.

#include <vector>

#include "engine/simulation/contacts/pair_table.h"

namespace carom {

/// Bodies at their starting poses, with their candidate pairs there.
struct StartingBodies {
  std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  std::span<const int> active;  ///< All of them.
  PairTable& table;
  const WorldSettings& settings;
};

/// Every pair of bodies that overlaps by more than rounding, where it does so most, deepest first.
std::vector<Overlap> overlapsAtStart(const StartingBodies& start);

/// For bodies without overlaps: whether some had to be moved. Then their paths are over, and the table holds
/// the pairs that they could have met on the way, queried where they are now. Bodies that lack the room for
/// rest gaps share what there is; where locked axes hold both of a pair its gap stays as it is.
bool openTouching(const StartingBodies& start);

/// The pairs of bodies that found no room, or no more than rounding, or no free axis that parts them.
std::vector<Overlap> stillTouching(const StartingBodies& start);

}  // namespace carom
