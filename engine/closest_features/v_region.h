#pragma once
// V-regions (paper §2, fig. 1). A point x lies in the V-region of the feature that holds p exactly when the
// direction x - p has no positive slope along any way off that feature: the edges out of a vertex, the two
// faces at an edge. Those slopes are the signed distances to the planes that bound the region, so the most
// violated plane names the neighbour to walk to. Tested in tests/engine/closest_features/v_region_test.cpp.

#include <optional>

#include "engine/closest_features/feature.h"
#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// The neighbour of `feature` (one dimension up) along which `direction` (polyhedron frame, any length)
/// climbs most steeply, or none when the direction lies in the feature's V-region. Cost: linear in the
/// feature's neighbours.
std::optional<Feature> neighbourAcrossVRegion(const ConvexPolyhedron& polyhedron, Feature feature,
                                              const Vec3& direction);

/// Whether a direction that passes every plane of the feature's V-region leads into the body all the same. A
/// flat edge (between coplanar faces) and a vertex among coplanar faces have V-planes that do not tell out
/// from in; but out lies in the cone of the faces' normals, so it climbs over at least one of them. False on
/// a point or segment.
bool pointsInward(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& direction);

}  // namespace carom
