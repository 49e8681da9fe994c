#include "engine/closest_features/feature_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/foundation/contract.h"

namespace carom {
namespace {

struct FeaturePoint {
  Feature feature;
  Vec3 p;
};

// An edge of either polyhedron, in the frame of A.
struct Segment {
  int index, tail_index, head_index;
  Vec3 tail, head, direction;
  double length_m;

  // The point at arc length s; at or beyond an end it is that vertex.
  FeaturePoint at(double s) const {
    if (s <= 0.0) return {vertexFeature(tail_index), tail};
    if (s >= length_m) return {vertexFeature(head_index), head};
    return {edgeFeature(index), tail + s * direction};
  }
  double arcLengthOf(const Vec3& p) const { return direction.dot(p - tail); }
};

Segment segmentOfA(const PolyhedronPair& pair, int e) {
  const Edge& edge = pair.a.edge(e);
  return {e,
          edge.tail,
          edge.head,
          pair.a.vertex(edge.tail),
          pair.a.vertex(edge.head),
          edge.direction,
          edge.length_m};
}

Segment segmentOfB(const PolyhedronPair& pair, int e) {
  const Edge& edge = pair.b.edge(e);
  return {e,
          edge.tail,
          edge.head,
          pair.toA(pair.b.vertex(edge.tail)),
          pair.toA(pair.b.vertex(edge.head)),
          pair.R_AB * edge.direction,
          edge.length_m};
}

FeatureDistance measure(const FeaturePoint& on_a, const FeaturePoint& on_b) {
  return {{on_a.feature, on_b.feature}, on_a.p, on_b.p, (on_b.p - on_a.p).norm(), false, false};
}

void keepCloser(FeatureDistance& best, const FeatureDistance& other) {
  if (other.distance_m < best.distance_m) best = other;
}

// E-E. The common perpendicular's feet when both lie inside; else an end of one against the other.
// Near-parallel edges make the feet uncertain but not the distance, because every candidate is measured
// between points.
FeatureDistance edgeEdge(const Segment& e1, const Segment& e2) {
  FeatureDistance best;
  best.distance_m = std::numeric_limits<double>::infinity();
  const Vec3 n = e1.direction.cross(e2.direction);
  const double sine_squared = n.squaredNorm();
  if (sine_squared > 0.0) {
    const double s1 = (e2.tail - e1.tail).cross(e2.direction).dot(n) / sine_squared;
    if (s1 > 0.0 && s1 < e1.length_m) {
      const FeaturePoint on1 = e1.at(s1);
      const double s2 = e2.arcLengthOf(on1.p);
      if (s2 > 0.0 && s2 < e2.length_m) best = measure(on1, e2.at(s2));
    }
  }
  for (const double s1 : {0.0, e1.length_m}) {
    const FeaturePoint on1 = e1.at(s1);
    keepCloser(best, measure(on1, e2.at(e2.arcLengthOf(on1.p))));
  }
  for (const double s2 : {0.0, e2.length_m}) {
    const FeaturePoint on2 = e2.at(s2);
    keepCloser(best, measure(e1.at(e1.arcLengthOf(on2.p)), on2));
  }
  return best;
}

// Whether the foot of p on the face's plane lies within the face: p in the prism over it.
bool overFace(const ConvexPolyhedron& polyhedron, int face, const Vec3& p) {
  for (int e : polyhedron.faceEdges(face)) {
    const Edge& edge = polyhedron.edge(e);
    if (polyhedron.intoFace(e, face).dot(p - polyhedron.vertex(edge.tail)) < 0.0) return false;
  }
  return true;
}

// V-F with the face on A.
FeatureDistance faceVertex(const PolyhedronPair& pair, int face, int vertex) {
  const FeaturePoint on_b{vertexFeature(vertex), pair.toA(pair.b.vertex(vertex))};
  const Plane& plane = pair.a.plane(face);
  if (overFace(pair.a, face, on_b.p)) {
    const double height = plane.signedDistance(on_b.p);
    return {{faceFeature(face), on_b.feature},
            on_b.p - height * plane.normal,
            on_b.p,
            std::abs(height),
            false,
            height < 0.0};
  }
  FeatureDistance best;
  best.distance_m = std::numeric_limits<double>::infinity();
  for (int e : pair.a.faceEdges(face)) {
    const Segment side = segmentOfA(pair, e);
    keepCloser(best, measure(side.at(side.arcLengthOf(on_b.p)), on_b));
  }
  return best;
}

// E-F with the face on A: the edge pierces it, or an end of the edge or a side of the face is closest.
FeatureDistance faceEdge(const PolyhedronPair& pair, int face, int e) {
  const Segment edge = segmentOfB(pair, e);
  const Plane& plane = pair.a.plane(face);
  const double h_tail = plane.signedDistance(edge.tail);
  const double h_head = plane.signedDistance(edge.head);
  if ((h_tail < 0.0) != (h_head < 0.0)) {
    const FeaturePoint x = edge.at(edge.length_m * (h_tail / (h_tail - h_head)));
    if (overFace(pair.a, face, x.p)) {
      FeatureDistance pierced = measure({faceFeature(face), x.p}, x);
      pierced.crossing = true;
      return pierced;
    }
  }
  FeatureDistance best = faceVertex(pair, face, edge.tail_index);
  keepCloser(best, faceVertex(pair, face, edge.head_index));
  for (int side : pair.a.faceEdges(face)) keepCloser(best, edgeEdge(segmentOfA(pair, side), edge));
  return best;
}

// A result found with the roles swapped, put back: points go to the frame of A.
FeatureDistance unswapped(const PolyhedronPair& pair, const FeatureDistance& r) {
  return {{r.features.b, r.features.a}, pair.toA(r.p_b), pair.toA(r.p_a), r.distance_m, r.crossing, r.behind};
}

}  // namespace

PolyhedronPair::PolyhedronPair(const ConvexPolyhedron& a_in, const Pose& X_WA, const ConvexPolyhedron& b_in,
                               const Pose& X_WB)
    : a(a_in), b(b_in) {
  const Mat3 R_AW = X_WA.rotation.toRotationMatrix().transpose();
  R_AB = R_AW * X_WB.rotation.toRotationMatrix();
  t_AB = R_AW * (X_WB.position - X_WA.position);
}

PolyhedronPair PolyhedronPair::swapped() const {
  return {b, a, R_AB.transpose(), -(R_AB.transpose() * t_AB)};
}

FeatureDistance featureDistance(const PolyhedronPair& pair, FeaturePair features) {
  const auto [fa, fb] = features;
  using enum FeatureKind;
  if (fb.kind == kFace) {
    REQUIRE(fa.kind != kFace, fa.index, fb.index);
    return unswapped(pair, featureDistance(pair.swapped(), {fb, fa}));
  }
  if (fa.kind == kFace)
    return fb.kind == kVertex ? faceVertex(pair, fa.index, fb.index) : faceEdge(pair, fa.index, fb.index);
  if (fa.kind == kEdge && fb.kind == kEdge)
    return edgeEdge(segmentOfA(pair, fa.index), segmentOfB(pair, fb.index));
  if (fa.kind == kEdge) {
    const FeaturePoint on_b{fb, pair.toA(pair.b.vertex(fb.index))};
    const Segment edge = segmentOfA(pair, fa.index);
    return measure(edge.at(edge.arcLengthOf(on_b.p)), on_b);
  }
  const FeaturePoint on_a{fa, pair.a.vertex(fa.index)};
  if (fb.kind == kEdge) {
    const Segment edge = segmentOfB(pair, fb.index);
    return measure(on_a, edge.at(edge.arcLengthOf(on_a.p)));
  }
  return measure(on_a, {fb, pair.toA(pair.b.vertex(fb.index))});
}

}  // namespace carom
