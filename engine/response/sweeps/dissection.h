#pragma once
// Nested dissection (George 1973): the bodies of a crowd divided in space into two halves, those again, and
// so on. Contact rows within different halves share no body that moves, so they can be swept at the same
// time; those between the halves of a part come after both. The division and the order of rows that it gives
// depend on the bodies alone, not on how many threads sweep them. Tested in
// tests/engine/response/sweeps/dissection_test.cpp.

#include <bit>
#include <span>

#include "engine/response/one_point/impulse.h"

namespace carom {

/// The parts are the nodes of a binary tree: the whole is 1, the halves of part k are 2k and 2k + 1.
inline constexpr int kWhole = 1;
inline constexpr int kNoPart = 0;  ///< Of bodies that are in no part: they give way to nothing.

/// Of what to divide, and how.
struct DissectionPlan {
  std::span<const ImpulseBody> bodies;
  /// Unit, those across which parts may be cut: the one along which a part is longest is taken. What stands
  /// is best cut upright: from below upwards, its loads go to and fro in no more sweeps than uncut.
  std::span<const Vec3> directions;
  int levels = 0;  ///< So many times are parts halved.
};

/// Writes the part of each of `members` (indices of the plan's bodies, put into another order here) to
/// `part_of`, which is as long as the bodies.
void dissect(const DissectionPlan& plan, std::span<int> members, std::span<int> part_of);

/// How often the whole was halved for it. Of parts of one depth, none has a body of another.
inline int depthOf(int part) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(part))) - 1;
}

/// The smallest part that has both bodies, of those that are in any.
inline int commonPart(int part_a, int part_b) {
  if (part_a == kNoPart) return part_b;
  if (part_b == kNoPart) return part_a;
  while (part_a != part_b) {  // both as far from the whole
    part_a /= 2;
    part_b /= 2;
  }
  return part_a;
}

}  // namespace carom
