#include "demos/overlay/v_region_shape.h"

#include <numbers>

#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

constexpr int kArcSteps = 12;  // Of a quarter turn or less.
constexpr int kDiscCorners = 48;
using std::numbers::pi;

// From p + reach u to p + reach v along the arc about p.
std::vector<Vec3> arc(const Vec3& p, const Vec3& u, const Vec3& v, double reach_m) {
  const Quat turn = Quat::FromTwoVectors(u, v);
  const Vec3 rotation = rotationOf(turn);
  std::vector<Vec3> points;
  for (int i = 0; i <= kArcSteps; ++i)
    points.push_back(p + reach_m * (rotationBy(static_cast<double>(i) / kArcSteps * rotation) * u));
  return points;
}

// The part of a V-plane at a vertex, between the normals of the two faces at an edge.
void addSector(RegionShape& shape, const Vec3& p, const Vec3& u, const Vec3& v, double reach_m) {
  std::vector<Vec3> rim = arc(p, u, v, reach_m);
  std::vector<Vec3> side = rim;
  side.push_back(p);
  shape.sides.push_back(std::move(side));
  shape.rims.push_back(std::move(rim));
}

void addDisc(RegionShape& shape, const Vec3& p, const Vec3& axis, double reach_m) {
  const TangentBasis plane = tangentBasis(axis);
  std::vector<Vec3> rim;
  for (int i = 0; i <= kDiscCorners; ++i) {
    const SineCosine turn = sineCosine(2.0 * pi * i / kDiscCorners);
    rim.push_back(p + reach_m * (turn.cosine * plane.t1 + turn.sine * plane.t2));
  }
  shape.sides.emplace_back(rim.begin(), rim.end() - 1);
  shape.rims.push_back(std::move(rim));
}

void addFace(RegionShape& shape, const ConvexPolyhedron& polyhedron, int face, double reach_m) {
  const Vec3 up = reach_m * polyhedron.plane(face).normal;
  std::vector<Vec3> rim;
  const std::span<const int> loop = polyhedron.faceVertices(face);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3& p = polyhedron.vertex(loop[i]);
    const Vec3& q = polyhedron.vertex(loop[(i + 1) % loop.size()]);
    shape.sides.push_back({p, q, q + up, p + up});
    rim.push_back(p + up);
  }
  rim.push_back(rim.front());
  shape.rims.push_back(std::move(rim));
}

void addEdge(RegionShape& shape, const ConvexPolyhedron& polyhedron, int index, double reach_m) {
  const Edge& edge = polyhedron.edge(index);
  const Vec3& p = polyhedron.vertex(edge.tail);
  const Vec3& q = polyhedron.vertex(edge.head);
  if (edge.left < 0) {
    addDisc(shape, p, edge.direction, reach_m);
    addDisc(shape, q, edge.direction, reach_m);
    return;
  }
  const Vec3& left = polyhedron.plane(edge.left).normal;
  const Vec3& right = polyhedron.plane(edge.right).normal;
  for (const Vec3& n : {left, right}) {
    const Vec3 up = reach_m * n;
    shape.sides.push_back({p, q, q + up, p + up});
    shape.rims.push_back({p + up, q + up});
  }
  addSector(shape, p, left, right, reach_m);
  addSector(shape, q, left, right, reach_m);
}

void addVertex(RegionShape& shape, const ConvexPolyhedron& polyhedron, int vertex, double reach_m) {
  const Vec3& p = polyhedron.vertex(vertex);
  for (const Spoke& spoke : polyhedron.spokes(vertex)) {
    const Edge& edge = polyhedron.edge(spoke.edge);
    if (edge.left < 0)
      addDisc(shape, p, spoke.direction, reach_m);
    else
      addSector(shape, p, polyhedron.plane(edge.left).normal, polyhedron.plane(edge.right).normal, reach_m);
  }
}

}  // namespace

RegionShape regionShape(const ConvexPolyhedron& polyhedron, Feature feature, double reach_m) {
  RegionShape shape;
  if (feature.kind == FeatureKind::kFace) addFace(shape, polyhedron, feature.index, reach_m);
  if (feature.kind == FeatureKind::kEdge) addEdge(shape, polyhedron, feature.index, reach_m);
  if (feature.kind == FeatureKind::kVertex) addVertex(shape, polyhedron, feature.index, reach_m);
  return shape;
}

std::vector<Vec3> featureCorners(const ConvexPolyhedron& polyhedron, Feature feature) {
  if (feature.kind == FeatureKind::kVertex) return {polyhedron.vertex(feature.index)};
  if (feature.kind == FeatureKind::kEdge) {
    const Edge& edge = polyhedron.edge(feature.index);
    return {polyhedron.vertex(edge.tail), polyhedron.vertex(edge.head)};
  }
  std::vector<Vec3> corners;
  for (int v : polyhedron.faceVertices(feature.index)) corners.push_back(polyhedron.vertex(v));
  return corners;
}

}  // namespace carom::demos
