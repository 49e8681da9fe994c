#include "engine/closest_features/v_region.h"

namespace carom {
namespace {

// A slope below this is rounding of a unit product: walking along it could not shorten the distance
// measurably.
constexpr double kFlatSlope = 1e-15;

}  // namespace

std::optional<Feature> neighbourAcrossVRegion(const ConvexPolyhedron& polyhedron, Feature feature,
                                              const Vec3& direction) {
  double steepest = kFlatSlope * direction.norm();
  std::optional<Feature> neighbour;
  const auto consider = [&](double slope, Feature next) {
    if (slope > steepest) {
      steepest = slope;
      neighbour = next;
    }
  };
  switch (feature.kind) {
    case FeatureKind::kVertex:
      for (int e : polyhedron.vertexEdges(feature.index)) {
        const Edge& edge = polyhedron.edge(e);
        const double along = edge.direction.dot(direction);
        consider(edge.tail == feature.index ? along : -along, edgeFeature(e));
      }
      break;
    case FeatureKind::kEdge: {
      const Edge& edge = polyhedron.edge(feature.index);
      if (edge.left >= 0) {
        consider(edge.into_left.dot(direction), faceFeature(edge.left));
        consider(edge.into_right.dot(direction), faceFeature(edge.right));
      }
      break;
    }
    case FeatureKind::kFace:
      break;  // the direction from a point inside a face to its closest point is the face's normal
  }
  return neighbour;
}

bool pointsInward(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& direction) {
  if (polyhedron.faceCount() == 0) return false;
  const auto sinksBelow = [&](int face) { return polyhedron.plane(face).normal.dot(direction) <= 0.0; };
  switch (feature.kind) {
    case FeatureKind::kFace:
      return sinksBelow(feature.index);
    case FeatureKind::kEdge:
      return sinksBelow(polyhedron.edge(feature.index).left) &&
             sinksBelow(polyhedron.edge(feature.index).right);
    case FeatureKind::kVertex:
      break;
  }
  for (int e : polyhedron.vertexEdges(feature.index)) {
    const Edge& edge = polyhedron.edge(e);
    if (!sinksBelow(edge.tail == feature.index ? edge.left : edge.right)) return false;  // each face once
  }
  return true;
}

}  // namespace carom
