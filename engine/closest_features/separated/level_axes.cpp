#include "engine/closest_features/separated/level_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

// The direction between witnesses is never trusted less than to this angle.
constexpr double kMostUncertainty = 1e-3;

// Calls visit(face) for the faces at a vertex whose normals are within an angle of n.
template <typename Visit>
void forEachLevelFace(const ConvexPolyhedron& polyhedron, int v, const Vec3& n, double sine, Visit&& visit) {
  for (const Spoke& spoke : polyhedron.spokes(v)) {
    const Edge& edge = polyhedron.edge(spoke.edge);
    const int face = edge.tail == v ? edge.left : edge.right;
    if (face < 0) continue;
    const Vec3& normal = polyhedron.plane(face).normal;
    if (dot(normal, n) > 0.0 && normal.cross(n).squaredNorm() <= sine * sine) visit(face);
  }
}

// The edges of a feature and at its ends that are level across n, to within an angle.
template <typename Visit>
void forEachLevelEdge(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& n, double sine,
                      Visit&& visit) {
  if (feature.kind == FeatureKind::kFace) return;
  if (feature.kind == FeatureKind::kEdge) return visit(feature.index);
  for (const Spoke& spoke : polyhedron.spokes(feature.index))
    if (std::abs(dot(spoke.direction, n)) <= sine) visit(spoke.edge);
}

// The side through which a way along a face leaves it.
int exitSide(const ConvexPolyhedron& polyhedron, int face, const Vec3& from, const Vec3& along) {
  const auto sides = polyhedron.faceSides(face);
  int exit = -1;
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double sinking = -dot(sides[i].normal, along);
    if (sinking <= 0.0) continue;
    if (const double t = sides[i].signedDistance(from) / sinking; t < first) {
      first = t;
      exit = polyhedron.faceEdges(face)[i];
    }
  }
  return exit;
}

}  // namespace

int vertexOf(const ConvexPolyhedron& polyhedron, Feature feature) {
  switch (feature.kind) {
    case FeatureKind::kVertex:
      return feature.index;
    case FeatureKind::kEdge:
      return polyhedron.edge(feature.index).tail;
    default:
      return polyhedron.faceVertices(feature.index)[0];
  }
}

double slabAlong(const PolyhedronPair& pair, const FeaturePair& start, const Vec3& n) {
  const Vec3& far_a = pair.a.vertex(pair.a.support(n, vertexOf(pair.a, start.a)));
  const int vb = pair.b.support(-pair.directionToB(n), vertexOf(pair.b, start.b));
  return dot(n, pair.toA(pair.b.vertex(vb)) - far_a);
}

void gatherLevelAxes(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m,
                     MinimumTranslations& axes) {
  axes.clear();
  const double sine = std::min(kMostUncertainty, 4.0 * std::sqrt(noise_m / std::abs(answer.gap_m)));
  const Feature a = answer.features.a, b = answer.features.b;
  const int va = vertexOf(pair.a, a);
  const int vb = vertexOf(pair.b, b);
  const Vec3 minus_n_B = -pair.directionToB(answer.normal);
  forEachLevelFace(pair.a, va, answer.normal, sine,
                   [&](int f) { axes.push_back(gapOverFaceOfA(pair, f, vb)); });
  forEachLevelFace(pair.b, vb, minus_n_B, sine, [&](int f) { axes.push_back(gapOverFaceOfB(pair, f, va)); });
  forEachLevelEdge(pair.a, a, answer.normal, sine, [&](int i) {
    forEachLevelEdge(pair.b, b, minus_n_B, sine, [&](int j) {
      if (const auto across = gapAcrossEdges(pair, i, j, answer.normal)) axes.push_back(*across);
    });
  });
  // Over a face, an edge that is level with it may be lower where it passes over one of the face's sides.
  if (a.kind == FeatureKind::kFace)
    forEachLevelEdge(pair.b, b, minus_n_B, sine, [&](int j) {
      const Edge& edge = pair.b.edge(j);
      const Vec3 along = pair.directionToA(edge.tail == vb ? edge.direction : Vec3(-edge.direction));
      const int side = exitSide(pair.a, a.index, answer.p_b, along);
      if (const auto across = gapAcrossEdges(pair, side, j, answer.normal)) axes.push_back(*across);
    });
  if (b.kind == FeatureKind::kFace)
    forEachLevelEdge(pair.a, a, answer.normal, sine, [&](int i) {
      const Edge& edge = pair.a.edge(i);
      const Vec3 along = pair.directionToB(edge.tail == va ? edge.direction : Vec3(-edge.direction));
      const int side = exitSide(pair.b, b.index, pair.toB(answer.p_a), along);
      if (const auto across = gapAcrossEdges(pair, i, side, answer.normal)) axes.push_back(*across);
    });
}

}  // namespace carom
