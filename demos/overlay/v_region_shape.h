#pragma once
// What can be drawn of a V-region (paper §2, fig. 1): the planes that bound it, cut off at a distance. A
// face's region is the prism over it; an edge's lies between its faces' normals and the planes at its ends; a
// vertex's between the normals of the faces around it. Tested in tests/demos/overlay/v_region_shape_test.cpp.

#include <vector>

#include "engine/closest_features/pair/feature.h"
#include "engine/solid/convex_polyhedron.h"

namespace carom::demos {

struct RegionShape {
  /// Plane convex polygons in the V-planes, in the polyhedron's frame.
  std::vector<std::vector<Vec3>> sides;
  /// Where the region is cut off, as closed or open lines.
  std::vector<std::vector<Vec3>> rims;
};

/// The region up to `reach_m` from the feature. A lone point's has neither sides nor rims; those of a segment
/// are shown by the discs at its ends.
RegionShape regionShape(const ConvexPolyhedron& polyhedron, Feature feature, double reach_m);

/// The corners of a feature: one, two, or a face's.
std::vector<Vec3> featureCorners(const ConvexPolyhedron& polyhedron, Feature feature);

}  // namespace carom::demos
