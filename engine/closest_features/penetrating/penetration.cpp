#include "engine/closest_features/penetrating/penetration.h"

#include <limits>

namespace carom {
namespace {

// Edges closer to parallel than this give no axis of their own: the faces beside them give it better.
constexpr double kNoAxisSine = 1e-10;
// Below this sine the rounding of a cross product, relative to it, would show in a gap.
constexpr double kSmallSine = 0.1;

void keepLarger(MinimumTranslation& best, const MinimumTranslation& other) {
  if (other.gap_m > best.gap_m) best = other;
}

// An edge of B in the frame of A, with its faces' normals negated: its arc on the Gauss map of the difference
// A - B.
struct EdgeOfB {
  int index;
  Vec3 tail, direction, arc_left, arc_right;
  bool has_faces;
};

EdgeOfB edgeOfB(const PolyhedronPair& pair, int e) {
  const Edge& edge = pair.b.edge(e);
  EdgeOfB result{e,
                 pair.toA(pair.b.vertex(edge.tail)),
                 pair.R_AB * edge.direction,
                 Vec3::Zero(),
                 Vec3::Zero(),
                 edge.left >= 0};
  if (result.has_faces) {
    result.arc_left = -(pair.R_AB * pair.b.plane(edge.left).normal);
    result.arc_right = -(pair.R_AB * pair.b.plane(edge.right).normal);
  }
  return result;
}

// Whether two edges make a face of the Minkowski difference: their arcs cross on the Gauss map. The left and
// right normals of a convex edge satisfy n_l x n_r = sin(angle) * direction, so the directions stand for the
// arcs' planes. A segment has no faces: its arc is the whole great circle.
bool makesMinkowskiFace(const ConvexPolyhedron& a, const Edge& e1, const EdgeOfB& e2) {
  double left2 = 0.0;
  double right1 = 0.0;
  if (e2.has_faces) {
    left2 = dot(e2.arc_left, e1.direction);
    if (left2 * dot(e2.arc_right, e1.direction) >= 0.0) return false;
  }
  if (e1.left >= 0) {
    right1 = dot(a.plane(e1.right).normal, e2.direction);
    if (right1 * dot(a.plane(e1.left).normal, e2.direction) >= 0.0) return false;
  }
  // Both arcs cross the other's great circle; the same hemisphere makes it a crossing and not its antipode.
  return !e2.has_faces || e1.left < 0 || left2 * right1 > 0.0;
}

// A direction that leans outwards from A at the crossing of two edges.
Vec3 outwardHint(const PolyhedronPair& pair, const Edge& e1, const EdgeOfB& e2) {
  if (e1.left >= 0) return pair.a.plane(e1.left).normal + pair.a.plane(e1.right).normal;
  if (e2.has_faces) return e2.arc_left + e2.arc_right;
  return e2.tail - pair.a.vertex(e1.tail);
}

void tryEdges(const PolyhedronPair& pair, MinimumTranslation& best) {
  for (int i2 = 0; i2 < pair.b.edgeCount(); ++i2) {
    const EdgeOfB e2 = edgeOfB(pair, i2);
    for (int i1 = 0; i1 < pair.a.edgeCount(); ++i1) {
      const Edge& e1 = pair.a.edge(i1);
      if (!makesMinkowskiFace(pair.a, e1, e2)) continue;
      const Vec3 outward = outwardHint(pair, e1, e2);
      const auto across = commonPerpendicular(e1.direction, e2.direction);
      if (!across || dot(across->towards(outward), e2.tail - pair.a.vertex(e1.tail)) <= best.gap_m) continue;
      // Of edges that are almost parallel the signs above may be rounding, and other vertices reach farther.
      if (const auto gap = gapAcrossEdges(pair, i1, i2, outward)) keepLarger(best, *gap);
    }
  }
}

}  // namespace

int faceTowards(const ConvexPolyhedron& polyhedron, int v, const Vec3& direction) {
  int best = -1;
  double most = -std::numeric_limits<double>::infinity();
  for (const Spoke& spoke : polyhedron.spokes(v)) {
    const Edge& edge = polyhedron.edge(spoke.edge);
    const int face = edge.tail == v ? edge.left : edge.right;
    if (face < 0) continue;
    if (const double facing = dot(polyhedron.plane(face).normal, direction); facing > most) {
      most = facing;
      best = face;
    }
  }
  return best;
}

MinimumTranslation gapOverFaceOfA(const PolyhedronPair& pair, int face, int start) {
  const Plane& plane = pair.a.plane(face);
  const int v = pair.b.support(-pair.directionToB(plane.normal), start);
  const Vec3 p = pair.toA(pair.b.vertex(v));
  const double gap = plane.signedDistance(p);
  return {gap, plane.normal, {faceFeature(face), vertexFeature(v)}, p - gap * plane.normal, p};
}

MinimumTranslation gapOverFaceOfB(const PolyhedronPair& pair, int face, int start) {
  const Plane& plane = pair.b.plane(face);
  const Vec3 n = -pair.directionToA(plane.normal);
  const int v = pair.a.support(n, start);
  const Vec3& p = pair.a.vertex(v);
  const double gap = plane.signedDistance(pair.toB(p));
  return {gap, n, {vertexFeature(v), faceFeature(face)}, p, p + gap * n};
}

std::optional<CommonPerpendicular> commonPerpendicular(const Vec3& d1, const Vec3& d2) {
  const Vec3 cross = d1.cross(d2);
  const double sine = cross.norm();
  if (sine < kNoAxisSine) return std::nullopt;
  const double inverse = 1.0 / sine;
  Vec3 n = inverse * cross;
  if (sine < kSmallSine) n = (n - dot(n, d1) * d1).normalized();
  return CommonPerpendicular{n, inverse};
}

std::optional<MinimumTranslation> gapAcrossEdges(const PolyhedronPair& pair, int edge_a, int edge_b,
                                                 const Vec3& outward) {
  const Edge& e1 = pair.a.edge(edge_a);
  const Edge& e2 = pair.b.edge(edge_b);
  const Vec3 d2 = pair.directionToA(e2.direction);
  const auto across = commonPerpendicular(e1.direction, d2);
  if (!across) return std::nullopt;
  const Vec3 n = across->towards(outward);
  const int va = pair.a.support(n, e1.tail);
  const int vb = pair.b.support(-pair.directionToB(n), e2.tail);
  const Vec3& tail1 = pair.a.vertex(e1.tail);
  const Vec3 between = pair.toA(pair.b.vertex(e2.tail)) - tail1;
  const Vec3 foot = tail1 + across->footAlong(between, d2) * e1.direction;
  const bool supporting = (va == e1.tail || va == e1.head) && (vb == e2.tail || vb == e2.head);
  const double gap = supporting ? dot(n, between) : dot(n, pair.toA(pair.b.vertex(vb)) - pair.a.vertex(va));
  return MinimumTranslation{gap, n, {edgeFeature(edge_a), edgeFeature(edge_b)}, foot, foot + gap * n};
}

MinimumTranslation largestGap(const PolyhedronPair& pair) {
  MinimumTranslation best;
  best.gap_m = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < pair.a.faceCount(); ++f) keepLarger(best, gapOverFaceOfA(pair, f, 0));
  for (int f = 0; f < pair.b.faceCount(); ++f) keepLarger(best, gapOverFaceOfB(pair, f, 0));
  tryEdges(pair, best);
  if (best.gap_m > -std::numeric_limits<double>::infinity()) return best;
  // Cores without faces or crossing edges that meet (balls with one centre, capsules on one line): any
  // direction across them separates the cores, so the rounding radii alone make the depth.
  best.gap_m = 0.0;
  best.features = {vertexFeature(0), vertexFeature(0)};
  if (pair.a.edgeCount() > 0)
    best.normal = tangentBasis(pair.a.edge(0).direction).t1;
  else if (pair.b.edgeCount() > 0)
    best.normal = tangentBasis(pair.R_AB * pair.b.edge(0).direction).t1;
  best.p_a = best.p_b = pair.a.vertex(0);
  return best;
}

}  // namespace carom
