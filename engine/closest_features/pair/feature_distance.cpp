#include "engine/closest_features/pair/feature_distance.h"

#include <algorithm>
#include <limits>

#include "engine/foundation/contract.h"

namespace carom {
namespace {

struct FeaturePoint {
  Feature feature;
  Vec3 p;
  double inside_m = std::numeric_limits<double>::infinity();  // from the feature's boundary
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
    return {edgeFeature(index), tail + s * direction, std::min(s, length_m - s)};
  }
  FeaturePoint nearest(const Vec3& p) const { return at(dot(direction, p - tail)); }
};

Segment segmentOf(const ConvexPolyhedron& a, int e) {
  const Edge& edge = a.edge(e);
  return {e, edge.tail, edge.head, a.vertex(edge.tail), a.vertex(edge.head), edge.direction, edge.length_m};
}

Segment segmentOfB(const PolyhedronPair& pair, int e) {
  const Edge& edge = pair.b.edge(e);
  return {e,
          edge.tail,
          edge.head,
          pair.toA(pair.b.vertex(edge.tail)),
          pair.toA(pair.b.vertex(edge.head)),
          pair.directionToA(edge.direction),
          edge.length_m};
}

FeatureDistance measure(const FeaturePoint& on_a, const FeaturePoint& on_b) {
  return {{on_a.feature, on_b.feature},
          on_a.p,
          on_b.p,
          (on_b.p - on_a.p).squaredNorm(),
          std::min(on_a.inside_m, on_b.inside_m)};
}

void keepCloser(FeatureDistance& best, const FeatureDistance& other) {
  if (other.squared_m2 < best.squared_m2) best = other;
}

// The ends of each edge against the other edge: what is closest when the common perpendicular is not.
FeatureDistance closestAtAnEnd(const Segment& e1, const Segment& e2) {
  FeatureDistance best = measure(e1.at(0.0), e2.nearest(e1.tail));
  keepCloser(best, measure(e1.at(e1.length_m), e2.nearest(e1.head)));
  keepCloser(best, measure(e1.nearest(e2.tail), e2.at(0.0)));
  keepCloser(best, measure(e1.nearest(e2.head), e2.at(e2.length_m)));
  return best;
}

// E-E. The common perpendicular's feet; where one lies beyond an end, that end against the other edge.
// Between near-parallel edges the feet are uncertain but not the distance, because every candidate is
// measured between points.
FeatureDistance edgeEdge(const Segment& e1, const Segment& e2) {
  const Vec3 n = e1.direction.cross(e2.direction);
  const double sine_squared = n.squaredNorm();
  if (sine_squared == 0.0) return closestAtAnEnd(e1, e2);
  const double s1 = dot((e2.tail - e1.tail).cross(e2.direction), n) / sine_squared;
  FeaturePoint on1 = e1.at(s1);
  const FeaturePoint on2 = e2.nearest(on1.p);
  if (on2.feature.kind == FeatureKind::kVertex) on1 = e1.nearest(on2.p);
  if (sine_squared > kCrossingSine * kCrossingSine) return measure(on1, on2);
  // The common perpendicular is uncertain: all ends are tried too.
  FeatureDistance best = closestAtAnEnd(e1, e2);
  keepCloser(best, measure(on1, on2));
  return best;
}

// Whether the foot of p on the face's plane lies within the face: p in the prism over it.
bool overFace(const ConvexPolyhedron& polyhedron, int face, const Vec3& p) {
  for (const Plane& side : polyhedron.faceSides(face))
    if (side.signedDistance(p) < 0.0) return false;
  return true;
}

// V-F with the face on `a`, both in its frame.
FeatureDistance faceVertex(const ConvexPolyhedron& a, int face, const FeaturePoint& on_b) {
  const double height = a.plane(face).signedDistance(on_b.p);
  const std::span<const Plane> sides = a.faceSides(face);
  double inside = std::numeric_limits<double>::infinity();
  std::size_t outermost = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (const double h = sides[i].signedDistance(on_b.p); h < inside) {
      inside = h;
      outermost = i;
    }
  if (inside >= 0.0)
    return {{faceFeature(face), on_b.feature},
            on_b.p - height * a.plane(face).normal,
            on_b.p,
            height * height,
            inside,
            false,
            height < 0.0};
  // The closest point is on a side that the vertex is beyond, at least as far as it is beyond its V-plane.
  const std::span<const int> edges = a.faceEdges(face);
  const FeaturePoint nearest = segmentOf(a, edges[outermost]).nearest(on_b.p);
  if (nearest.feature.kind == FeatureKind::kEdge) return measure(nearest, on_b);
  FeatureDistance best = measure(nearest, on_b);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double h = sides[i].signedDistance(on_b.p);
    if (h < 0.0 && h * h <= best.squared_m2)
      keepCloser(best, measure(segmentOf(a, edges[i]).nearest(on_b.p), on_b));
  }
  return best;
}

// E-F with the face on `a`, both in its frame: the edge pierces it, or an end of the edge or a side of the
// face is closest.
FeatureDistance faceEdge(const ConvexPolyhedron& a, int face, const Segment& edge) {
  const double h_tail = a.plane(face).signedDistance(edge.tail);
  const double h_head = a.plane(face).signedDistance(edge.head);
  if ((h_tail < 0.0) != (h_head < 0.0)) {
    const FeaturePoint x = edge.at(edge.length_m * (h_tail / (h_tail - h_head)));
    if (overFace(a, face, x.p)) {
      FeatureDistance pierced = measure({faceFeature(face), x.p}, x);
      pierced.crossing = true;
      return pierced;
    }
  }
  FeatureDistance best = faceVertex(a, face, edge.at(0.0));
  keepCloser(best, faceVertex(a, face, edge.at(edge.length_m)));
  // A side is closest only where the edge reaches beyond its V-plane, and no closer than that.
  const std::span<const Plane> sides = a.faceSides(face);
  const std::span<const int> edges = a.faceEdges(face);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const double beyond_tail = sides[i].signedDistance(edge.tail);
    const double beyond_head = sides[i].signedDistance(edge.head);
    const double least = std::max(beyond_tail, beyond_head);
    if (std::min(beyond_tail, beyond_head) > 0.0 || (least < 0.0 && least * least > best.squared_m2))
      continue;
    keepCloser(best, edgeEdge(segmentOf(a, edges[i]), edge));
  }
  return best;
}

// A result found in the frame of B with the roles swapped, put back.
FeatureDistance unswapped(const PolyhedronPair& pair, const FeatureDistance& r) {
  return {{r.features.b, r.features.a},
          pair.toA(r.p_b),
          pair.toA(r.p_a),
          r.squared_m2,
          r.inside_m,
          r.crossing,
          r.behind};
}

// An edge of A in the frame of B.
Segment segmentInB(const PolyhedronPair& pair, int e) {
  const Edge& edge = pair.a.edge(e);
  return {e,
          edge.tail,
          edge.head,
          pair.toB(pair.a.vertex(edge.tail)),
          pair.toB(pair.a.vertex(edge.head)),
          pair.directionToB(edge.direction),
          edge.length_m};
}

}  // namespace

FeatureDistance featureDistance(const PolyhedronPair& pair, FeaturePair features) {
  const auto [fa, fb] = features;
  using enum FeatureKind;
  if (fb.kind == kFace) {
    REQUIRE(fa.kind != kFace, fa.index, fb.index);
    if (fa.kind == kEdge) return unswapped(pair, faceEdge(pair.b, fb.index, segmentInB(pair, fa.index)));
    const FeaturePoint on_a{fa, pair.toB(pair.a.vertex(fa.index))};
    return unswapped(pair, faceVertex(pair.b, fb.index, on_a));
  }
  if (fb.kind == kEdge) {
    const Segment edge = segmentOfB(pair, fb.index);
    if (fa.kind == kFace) return faceEdge(pair.a, fa.index, edge);
    if (fa.kind == kEdge) return edgeEdge(segmentOf(pair.a, fa.index), edge);
    const Vec3& p = pair.a.vertex(fa.index);
    return measure({fa, p}, edge.nearest(p));
  }
  const FeaturePoint on_b{fb, pair.toA(pair.b.vertex(fb.index))};
  if (fa.kind == kFace) return faceVertex(pair.a, fa.index, on_b);
  if (fa.kind == kEdge) return measure(segmentOf(pair.a, fa.index).nearest(on_b.p), on_b);
  return measure({fa, pair.a.vertex(fa.index)}, on_b);
}

}  // namespace carom
