#pragma once
// V-regions (paper §2, fig. 1). A point x lies in the V-region of the feature that holds p exactly when the
// direction x - p has no positive slope along any way off that feature: the edges out of a vertex, the two
// faces at an edge. Those slopes are the signed distances to the planes that bound the region, so the most
// violated plane names the neighbour to walk to. Tested in
// tests/engine/closest_features/pair/v_region_test.cpp.

#include <limits>

#include "engine/closest_features/pair/feature.h"
#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// A unit way from a feature to a neighbour one dimension up, and how steeply a direction climbs along it.
struct WayOff {
  double slope = -std::numeric_limits<double>::infinity();  ///< No way off (a face, a lone point).
  Feature neighbour;
};

/// The way off `feature` along which `direction` (polyhedron frame, any length; slopes are in its units)
/// climbs most steeply. At most 0: the direction lies in the feature's V-region. Cost: linear in the
/// feature's neighbours.
inline WayOff steepestWayOff(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& direction) {
  WayOff steepest;
  if (feature.kind == FeatureKind::kVertex) {
    for (const Spoke& spoke : polyhedron.spokes(feature.index))
      if (const double slope = dot(spoke.direction, direction); slope > steepest.slope)
        steepest = {slope, edgeFeature(spoke.edge)};
  } else if (feature.kind == FeatureKind::kEdge) {
    const Edge& edge = polyhedron.edge(feature.index);
    if (edge.left < 0) return steepest;
    const double left = dot(edge.into_left, direction);
    const double right = dot(edge.into_right, direction);
    steepest = left > right ? WayOff{left, faceFeature(edge.left)} : WayOff{right, faceFeature(edge.right)};
  }
  return steepest;
}

/// Whether a direction that passes every plane of the feature's V-region leads into the body all the same. A
/// flat edge (between coplanar faces) and a vertex among coplanar faces have V-planes that do not tell out
/// from in; but out lies in the cone of the faces' normals, so it climbs over at least one of them. False on
/// a point or segment.
bool pointsInward(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& direction);

}  // namespace carom
