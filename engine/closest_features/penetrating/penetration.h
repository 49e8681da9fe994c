#pragma once
// The minimum translation of two intersecting polyhedra. By the separating-axis theorem its direction is a
// face normal of one, or across an edge of each whose arcs cross on the Gauss map: only those are faces of
// the Minkowski difference. Here are the gaps along such axes one by one, and the search through all of them
// (faces x support + edges x edges) that answers where the tracked search (inner_polytope.h) has nothing to
// grow in. Tested in tests/engine/closest_features/penetrating/penetration_test.cpp.

#include <optional>

#include "engine/closest_features/pair/feature_distance.h"
#include "engine/foundation/stack_arena.h"

namespace carom {

/// Frame of A; `normal` from A to B. `gap_m` < 0 is minus the depth; > 0 by rounding only when they barely
/// touch.
struct MinimumTranslation {
  double gap_m = 0.0;
  Vec3 normal = Vec3::UnitZ();
  FeaturePair features;
  Vec3 p_a = Vec3::Zero();  ///< On A's surface.
  Vec3 p_b = Vec3::Zero();  ///< On B's surface; p_b - p_a = gap * normal.
};
/// Several of them, in memory of the caller's choice (stack_arena.h).
using MinimumTranslations = ArenaVector<MinimumTranslation>;

/// Of the faces at a vertex, the one that faces `direction` most; -1 on a point or segment.
int faceTowards(const ConvexPolyhedron& polyhedron, int v, const Vec3& direction);

/// The gap along a face's normal, to the other body's support vertex, climbed to from `start`.
MinimumTranslation gapOverFaceOfA(const PolyhedronPair& pair, int face, int start);
MinimumTranslation gapOverFaceOfB(const PolyhedronPair& pair, int face, int start);

/// Across two unit directions.
struct CommonPerpendicular {
  Vec3 direction;       ///< Unit; one of two.
  double inverse_sine;  ///< Of the angle between the two directions.

  Vec3 towards(const Vec3& outward) const {
    return dot(direction, outward) < 0.0 ? Vec3(-direction) : direction;
  }
  /// Of two lines along d1 and d2, how far along d1 the foot is from a point of the first, with `between`
  /// from there to a point of the second, metres.
  double footAlong(const Vec3& between, const Vec3& d2) const {
    return dot(between.cross(d2), direction) * inverse_sine;
  }
};

/// To rounding across d1, and as nearly across d2 however small the angle between them; none when they are
/// parallel.
std::optional<CommonPerpendicular> commonPerpendicular(const Vec3& d1, const Vec3& d2);

/// The gap along the common perpendicular of two edges that leans along `outward`, between the support
/// vertices climbed to from the edges; none when they are parallel.
std::optional<MinimumTranslation> gapAcrossEdges(const PolyhedronPair& pair, int edge_a, int edge_b,
                                                 const Vec3& outward);

/// The largest gap over all axes.
MinimumTranslation largestGap(const PolyhedronPair& pair);

}  // namespace carom
