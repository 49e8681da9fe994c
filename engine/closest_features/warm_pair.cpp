#include "engine/closest_features/warm_pair.h"

#include <algorithm>
#include <cmath>

#include "engine/closest_features/v_region.h"

namespace carom {
namespace {

// Edges that cross at a smaller angle have no well-defined common perpendicular.
constexpr double kCrossingSineSquared = 1e-6;

double steepestSpoke(const ConvexPolyhedron& polyhedron, int v, const Vec3& direction) {
  double steepest = -std::numeric_limits<double>::infinity();
  for (const Spoke& spoke : polyhedron.spokes(v))
    steepest = std::max(steepest, spoke.direction.dot(direction));
  return steepest;
}

double steeperSide(const Edge& edge, const Vec3& direction) {
  return std::max(edge.into_left.dot(direction), edge.into_right.dot(direction));
}

class WarmPair {
 public:
  WarmPair(const PolyhedronPair& pair, double noise_m)
      : pair_(pair),
        noise_m_(noise_m),
        noise_slope_(noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge())) {}

  // A vertex of `b` over a face of `a`, both in the frame of `a`; `n_b` is the face's normal to `b`'s frame.
  bool overFace(const ConvexPolyhedron& a, int face, const Vec3& p, const ConvexPolyhedron& b, int v,
                const Vec3& n_b, double& height) const {
    height = a.plane(face).signedDistance(p);
    double inside = height;
    for (const Plane& side : a.faceSides(face)) inside = std::min(inside, side.signedDistance(p));
    return inside > noise_m_ && steepestSpoke(b, v, -n_b) < -noise_slope_;
  }

  bool faceVertex(int face, int v, CoreAnswer& answer) const {
    const Vec3& n = pair_.a.plane(face).normal;
    answer.p_b = pair_.toA(pair_.b.vertex(v));
    if (!overFace(pair_.a, face, answer.p_b, pair_.b, v, pair_.directionToB(n), answer.gap_m)) return false;
    answer.normal = n;
    answer.p_a = answer.p_b - answer.gap_m * n;
    return true;
  }

  bool vertexFace(int v, int face, CoreAnswer& answer) const {
    const Vec3 n_a = pair_.directionToA(pair_.b.plane(face).normal);
    answer.p_a = pair_.a.vertex(v);
    if (!overFace(pair_.b, face, pair_.toB(answer.p_a), pair_.a, v, n_a, answer.gap_m)) return false;
    answer.normal = -n_a;
    answer.p_b = answer.p_a - answer.gap_m * n_a;
    return true;
  }

  bool edgeEdge(int e1, int e2, CoreAnswer& answer) const {
    const Edge& a = pair_.a.edge(e1);
    const Edge& b = pair_.b.edge(e2);
    if (a.left < 0 || b.left < 0) return false;  // segments have no sides: left to the walk
    const Vec3 d2 = pair_.directionToA(b.direction);
    const Vec3 across = a.direction.cross(d2);
    const double sine_squared = across.squaredNorm();
    if (sine_squared < kCrossingSineSquared) return false;
    const Vec3& tail1 = pair_.a.vertex(a.tail);
    const Vec3 between = pair_.toA(pair_.b.vertex(b.tail)) - tail1;
    const double inverse = 1.0 / sine_squared;
    const double s1 = between.cross(d2).dot(across) * inverse;
    const double s2 = between.cross(a.direction).dot(across) * inverse;
    const double inside = std::min(std::min(s1, a.length_m - s1), std::min(s2, b.length_m - s2));
    if (!(inside > noise_m_)) return false;
    const double sine = std::sqrt(sine_squared);
    const double along = between.dot(across);
    const Vec3 w = along > 0.0 ? across : -across;
    const double steepest = std::max(steeperSide(a, w), steeperSide(b, -pair_.directionToB(w)));
    if (!(steepest < -noise_slope_ * sine) || std::abs(along) < noise_m_ * sine) return false;
    answer.normal = w * (sine * inverse);
    answer.gap_m = std::abs(along) * (sine * inverse);
    answer.p_a = tail1 + s1 * a.direction;
    answer.p_b = answer.p_a + answer.gap_m * answer.normal;
    return true;
  }

  // The foot of p on an edge, inside its ends, and the way from it to p outside of the faces beside it.
  bool besideEdge(const ConvexPolyhedron& a, int e, const Vec3& p, Vec3& foot, Vec3& w) const {
    const Edge& edge = a.edge(e);
    if (edge.left < 0) return false;
    const Vec3& tail = a.vertex(edge.tail);
    const double s = edge.direction.dot(p - tail);
    if (!(std::min(s, edge.length_m - s) > noise_m_)) return false;
    foot = tail + s * edge.direction;
    w = p - foot;
    w -= edge.direction.dot(w) * edge.direction;  // of a short way rounding would leave a slope
    return true;
  }

  bool edgeVertex(int e, int v, CoreAnswer& answer) const {
    Vec3 w;
    answer.p_b = pair_.toA(pair_.b.vertex(v));
    if (!besideEdge(pair_.a, e, answer.p_b, answer.p_a, w)) return false;
    const double steepest =
        std::max(steeperSide(pair_.a.edge(e), w), steepestSpoke(pair_.b, v, -pair_.directionToB(w)));
    return along(w, steepest, answer);
  }

  bool vertexEdge(int v, int e, CoreAnswer& answer) const {
    Vec3 foot, w;
    answer.p_a = pair_.a.vertex(v);
    if (!besideEdge(pair_.b, e, pair_.toB(answer.p_a), foot, w)) return false;
    const Vec3 w_a = -pair_.directionToA(w);
    const double steepest = std::max(steeperSide(pair_.b.edge(e), w), steepestSpoke(pair_.a, v, w_a));
    answer.p_b = answer.p_a + w_a;
    return along(w_a, steepest, answer);
  }

  bool vertexVertex(int v1, int v2, CoreAnswer& answer) const {
    answer.p_a = pair_.a.vertex(v1);
    answer.p_b = pair_.toA(pair_.b.vertex(v2));
    const Vec3 w = answer.p_b - answer.p_a;
    return along(w,
                 std::max(steepestSpoke(pair_.a, v1, w), steepestSpoke(pair_.b, v2, -pair_.directionToB(w))),
                 answer);
  }

 private:
  // The direction w between the witnesses is off by rounding, noise / |w|: so are the slopes along it.
  bool along(const Vec3& w, double steepest, CoreAnswer& answer) const {
    const double distance = w.norm();
    if (!(steepest < -(noise_slope_ * distance + noise_m_)) || distance < noise_m_) return false;
    answer.gap_m = distance;
    answer.normal = w / distance;
    return true;
  }

  const PolyhedronPair& pair_;
  double noise_m_, noise_slope_;
};

}  // namespace

bool clearlyClosest(const PolyhedronPair& pair, FeaturePair features, double noise_m, CoreAnswer& answer) {
  const WarmPair warm(pair, noise_m);
  answer.features = features;
  const auto [a, b] = features;
  using enum FeatureKind;
  switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
    case 3 * static_cast<int>(kVertex) + static_cast<int>(kVertex):
      return warm.vertexVertex(a.index, b.index, answer);
    case 3 * static_cast<int>(kVertex) + static_cast<int>(kEdge):
      return warm.vertexEdge(a.index, b.index, answer);
    case 3 * static_cast<int>(kVertex) + static_cast<int>(kFace):
      return warm.vertexFace(a.index, b.index, answer);
    case 3 * static_cast<int>(kEdge) + static_cast<int>(kVertex):
      return warm.edgeVertex(a.index, b.index, answer);
    case 3 * static_cast<int>(kEdge) + static_cast<int>(kEdge):
      return warm.edgeEdge(a.index, b.index, answer);
    case 3 * static_cast<int>(kFace) + static_cast<int>(kVertex):
      return warm.faceVertex(a.index, b.index, answer);
    default:
      return false;
  }
}

bool clearlyAlone(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m) {
  const auto [a, b] = answer.features;
  const double noise_slope = noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge());
  const auto within = [noise_m](const ConvexPolyhedron& polyhedron, int face, const Vec3& p) {
    double inside = std::numeric_limits<double>::infinity();
    for (const Plane& side : polyhedron.faceSides(face)) inside = std::min(inside, side.signedDistance(p));
    return inside > noise_m;
  };
  const Vec3 minus_n_B = -pair.directionToB(answer.normal);
  if (a.kind == FeatureKind::kFace)
    return within(pair.a, a.index, answer.p_b) && steepestSpoke(pair.b, b.index, minus_n_B) < -noise_slope;
  if (b.kind == FeatureKind::kFace)
    return within(pair.b, b.index, pair.toB(answer.p_a)) &&
           steepestSpoke(pair.a, a.index, answer.normal) < -noise_slope;
  if (a.kind != FeatureKind::kEdge || b.kind != FeatureKind::kEdge) return false;
  const Edge& e1 = pair.a.edge(a.index);
  const Edge& e2 = pair.b.edge(b.index);
  if (e1.left < 0 || e2.left < 0) return false;
  const double s1 = e1.direction.dot(answer.p_a - pair.a.vertex(e1.tail));
  const double s2 = e2.direction.dot(pair.toB(answer.p_b) - pair.b.vertex(e2.tail));
  return std::min(std::min(s1, e1.length_m - s1), std::min(s2, e2.length_m - s2)) > noise_m &&
         std::max(steeperSide(e1, answer.normal), steeperSide(e2, minus_n_B)) < -noise_slope;
}

}  // namespace carom
