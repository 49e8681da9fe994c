#pragma once
// Where to begin the search for a support vertex: a table over the directions of a cube map, with about as
// many cells as the polyhedron has vertices, so that a climb from the table's answer takes about one step
// on round bodies of any size; on a prism of n sides 0.12 sqrt(n). Tested in
// tests/engine/solid/support_table_test.cpp.

#include <functional>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

class SupportTable {
 public:
  SupportTable() = default;
  /// `support(direction, start)` climbs from `start` to the farthest vertex. Few vertices make no table.
  SupportTable(int vertex_count, const std::function<int(const Vec3&, int)>& support);

  /// A vertex at or near the farthest along `direction` (any length; of zero, or what is no number, some
  /// vertex).
  int vertexNear(const Vec3& direction) const {
    return cells_per_side_ == 0 ? 0 : vertices_[cellOf(direction)];
  }

 private:
  std::size_t cellOf(const Vec3& direction) const;
  Vec3 middleOf(int axis, bool negative, int i, int j) const;

  int cells_per_side_ = 0;
  std::vector<int> vertices_;  // by axis and sign, then row, then column
};

}  // namespace carom
