#include "engine/closest_features/pair/v_region.h"

namespace carom {

bool pointsInward(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& direction) {
  if (polyhedron.faceCount() == 0) return false;
  const auto sinksBelow = [&](int face) { return dot(polyhedron.plane(face).normal, direction) <= 0.0; };
  switch (feature.kind) {
    case FeatureKind::kFace:
      return sinksBelow(feature.index);
    case FeatureKind::kEdge:
      return sinksBelow(polyhedron.edge(feature.index).left) &&
             sinksBelow(polyhedron.edge(feature.index).right);
    case FeatureKind::kVertex:
      break;
  }
  for (const Spoke& spoke : polyhedron.spokes(feature.index)) {
    const Edge& edge = polyhedron.edge(spoke.edge);
    if (!sinksBelow(edge.tail == feature.index ? edge.left : edge.right)) return false;  // each face once
  }
  return true;
}

}  // namespace carom
