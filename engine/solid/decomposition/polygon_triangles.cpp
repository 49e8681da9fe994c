#include "engine/solid/decomposition/polygon_triangles.h"

#include <cmath>

#include "engine/foundation/index.h"
#include "engine/solid/decomposition/ear_clipping.h"
#include "engine/solid/decomposition/joined_ring.h"
#include "engine/solid/decomposition/plane_sides.h"

namespace carom {

double twiceArea(const std::vector<int>& ring, const std::vector<Vec2>& corners) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    area += turnOf(corners[at(ring[0])], corners[at(ring[i])], corners[at(ring[i + 1])]);
  return area;
}

std::optional<PolygonTriangles> polygonTriangles(const Rings& rings, const std::vector<Vec2>& corners,
                                                 double tolerance_m) {
  const std::optional<JoinedRing> joined = joinedRing(rings, corners, tolerance_m);
  if (!joined) return std::nullopt;
  std::optional<PolygonTriangles> found = clippedEars(*joined, corners, tolerance_m);
  if (!found) return std::nullopt;
  // Triangles that overlap cover more than the region.
  double covered = 0.0, area = 0.0, sides = 0.0;
  for (const std::array<int, 3>& t : found->triangles)
    covered += std::abs(turnOf(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]));
  for (const std::vector<int>& ring : rings) {
    area += twiceArea(ring, corners);
    for (std::size_t i = 0; i < ring.size(); ++i)
      sides += (corners[at(ring[i])] - corners[at(ring[(i + 1) % ring.size()])]).norm();
  }
  // Each triangle is off by the tolerance times its longest side at most, which is no longer than half of all
  // rings together.
  if (covered - area > 2.0 * tolerance_m * sides * static_cast<double>(found->triangles.size()))
    return std::nullopt;
  return found;
}

}  // namespace carom
