#pragma once
// The convex hull of a point set or mesh, through qhull; facets coplanar within a tolerance become one face
// and their planes are refitted. The only file that names qhull is convex_hull.cpp. Tested in
// tests/engine/solid/convex_hull_test.cpp.

#include <span>

#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// What the hull made of its input.
struct HullReport {
  int points_given = 0;
  int points_dropped = 0;  ///< Interior, duplicate, or within the tolerance of a face or edge.
  int facets_merged = 0;   ///< Facets of the triangulated hull that became part of a larger face.
};

struct Hull {
  ConvexPolyhedron polyhedron;
  HullReport report;
};

/// The hull of at least four points that span a volume. Throws InputError for non-finite, too few,
/// coincident, collinear or coplanar ("flat") points. Cost O(n log n).
Hull convexHull(std::span<const Vec3> points);

}  // namespace carom
