#pragma once
// Triangles of a plane polygon with holes, without points of its own: holes are joined to the ring around
// them by bridges, then ears are clipped (Meisters 1975), the best-shaped first. Rings may touch themselves
// and each other, run back along themselves, and have corners in the middle of straight sides. Tested in
// tests/engine/solid/decomposition/polygon_triangles_test.cpp.

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

/// Of points in a plane: along its tangents.
struct PlaneCoordinates {
  TangentBasis basis;
  Vec2 operator()(const Vec3& p) const { return {dot(basis.t1, p), dot(basis.t2, p)}; }
};

/// Rings of corner numbers, the region on the left of each: the outer one counter-clockwise, holes clockwise.
using Rings = std::vector<std::vector<int>>;

/// Twice the area on the left of a ring.
double twiceArea(const std::vector<int>& ring, const std::vector<Vec2>& corners);

/// A side of a triangle (3 * triangle + side), or of a ring (-1 - the corner that it begins at).
using SideNumber = int;
constexpr SideNumber ringSide(int corner) {
  return -1 - corner;
}

struct PolygonTriangles {
  /// Corner numbers, counter-clockwise; some have no area.
  std::vector<std::array<int, 3>> triangles;
  /// Which sides lie on each other: every side of a triangle and of a ring is in exactly one pair. A ring
  /// that runs back along itself has pairs of its own sides.
  std::vector<std::pair<SideNumber, SideNumber>> joins;
};

/// No corner may occur twice, in one ring or in two. Corners nearer to a line than `tolerance_m` are on it.
/// Nothing where rounding leaves no way: the triangles found would not fill the region. Cost: corners times
/// their logarithm, mostly; for each hole, its corners times those around it.
std::optional<PolygonTriangles> polygonTriangles(const Rings& rings, const std::vector<Vec2>& corners,
                                                 double tolerance_m);

}  // namespace carom
