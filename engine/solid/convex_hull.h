#pragma once
// The convex hull of a point set or mesh, through qhull; facets coplanar within a tolerance become one face
// and their planes are refitted. Vertices keep the order of the points given, and faces are in the order of
// their vertices, so that features are numbered by the input alone. The only file that names qhull is
// convex_hull.cpp. Tested in tests/engine/solid/convex_hull_test.cpp.

#include <span>

#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// What counts as coplanar. The larger of the two tolerances decides.
struct HullSettings {
  /// Relative to the size of the point set.
  double coplanar_tolerance = 1e-11;
  /// How far each coordinate may be from what was meant: the rounding of the file it comes from, metres.
  /// Qhull adds the rounding of doubles itself.
  double coordinate_error_m = 0.0;
};

/// What the hull made of its input.
struct HullReport {
  int points_given = 0;
  int points_dropped = 0;      ///< All that are no vertices: the sum of the next two.
  int duplicates_dropped = 0;  ///< Equal to a point before them.
  int interior_dropped = 0;    ///< Inside, or on a face or edge to within the tolerance.
  int facets_merged = 0;       ///< Facets of the triangulated hull that became part of a larger face.
  double tolerance_m = 0.0;  ///< What counted as coplanar; less than asked for where that made no polyhedron.
  double farthest_moved_m = 0.0;    ///< Of a vertex, to make the faces around it planar.
  double farthest_outside_m = 0.0;  ///< Of a dropped point, beyond the face nearest to it.
};

struct Hull {
  ConvexPolyhedron polyhedron;
  HullReport report;
};

/// The hull of at least four points that span a volume. Its vertices are points given, unless merged faces
/// bend by more than rounding: then they are moved, by a few tolerances at most. Throws InputError for
/// non-finite, too few, coincident, collinear or coplanar ("flat") points. Cost O(n log n).
Hull convexHull(std::span<const Vec3> points, const HullSettings& settings = {});

}  // namespace carom
