#include "engine/closest_features/separated/warm_pair.h"

#include <algorithm>
#include <cmath>

#include "engine/closest_features/pair/v_region.h"

namespace carom {
namespace {

constexpr int kMostTried = 8;  // tried before a walk begins
// The cosine of how far apart the ways across features that lie side by side may be.
constexpr double kBeside = 0.95;

double steepestSpoke(const ConvexPolyhedron& polyhedron, int v, const Vec3& direction) {
  double steepest = -std::numeric_limits<double>::infinity();
  for (const Spoke& spoke : polyhedron.spokes(v))
    steepest = std::max(steepest, dot(spoke.direction, direction));
  return steepest;
}

bool isOf(const ConvexPolyhedron& polyhedron, Feature feature) {
  const int count = feature.kind == FeatureKind::kVertex ? polyhedron.vertexCount()
                    : feature.kind == FeatureKind::kEdge ? polyhedron.edgeCount()
                                                         : polyhedron.faceCount();
  return feature.index >= 0 && feature.index < count;
}

double steeperSide(const Edge& edge, const Vec3& direction) {
  return std::max(dot(edge.into_left, direction), dot(edge.into_right, direction));
}

class WarmPair {
 public:
  WarmPair(const PlacedPolyhedron& a, const PlacedPolyhedron& b, double noise_m)
      : a_(a),
        b_(b),
        noise_m_(noise_m),
        noise_slope_(noise_m *
                     std::max(a.polyhedron.inverseShortestEdge(), b.polyhedron.inverseShortestEdge())) {}

  // Whether `features` are certified to be the closest.
  bool proves(FeaturePair features, PlacedGap& gap) const {
    const auto [a, b] = features;
    using enum FeatureKind;
    switch (3 * static_cast<int>(a.kind) + static_cast<int>(b.kind)) {
      case 3 * static_cast<int>(kVertex) + static_cast<int>(kVertex):
        return vertexVertex(a.index, b.index, gap);
      case 3 * static_cast<int>(kVertex) + static_cast<int>(kEdge):
        return vertexEdge(a.index, b.index, gap);
      case 3 * static_cast<int>(kVertex) + static_cast<int>(kFace):
        return vertexFace(a.index, b.index, gap);
      case 3 * static_cast<int>(kEdge) + static_cast<int>(kVertex):
        return edgeVertex(a.index, b.index, gap);
      case 3 * static_cast<int>(kEdge) + static_cast<int>(kEdge):
        return edgeEdge(a.index, b.index, gap);
      case 3 * static_cast<int>(kFace) + static_cast<int>(kVertex):
        return faceVertex(a.index, b.index, gap);
      default:
        return false;
    }
  }

  // Where features that are not certified lead on: over the border that the other body's witness is
  // farthest beyond, else up the steepest way off them; nowhere from two faces or a face and an edge.
  FeaturePair leadsTo(FeaturePair features) const {
    const auto [a, b] = features;
    if (a.kind < b.kind) {
      const FeaturePair next = WarmPair(b_, a_, noise_m_).leadsTo({b, a});
      return {next.b, next.a};
    }
    using enum FeatureKind;
    if (a.kind == kFace) return b.kind == kVertex ? fromFaceVertex(a.index, b.index) : features;
    if (b.kind == kEdge) return fromEdgeEdge(a.index, b.index);
    return a.kind == kEdge ? fromEdgeVertex(a.index, b.index) : upFrom(features, between(a.index, b.index));
  }

  // Whether features are far from the closest ones. The plane across the way between closest points supports
  // its body, so it clears the ball within (a face's own plane always does); across features beside them it
  // almost does.
  bool faceAway(FeaturePair features) const {
    const Vec3 w = wayAcross(features);
    const double squared = kBeside * kBeside * w.squaredNorm();
    const auto clears = [squared](const PlacedPolyhedron& body, Feature feature, const Vec3& out) {
      if (feature.kind == FeatureKind::kFace) return true;
      const InnerBall& ball = body.polyhedron.innerBall();
      const double height = dot(body.directionBack(out), pointOf(body.polyhedron, feature) - ball.center);
      return height >= 0.0 && height * height >= ball.radius_m * ball.radius_m * squared;
    };
    return !clears(b_, features.b, -w) || !clears(a_, features.a, w);
  }

 private:
  bool faceVertex(int face, int v, PlacedGap& gap) const {
    const Vec3 p_b = b_.point(b_.polyhedron.vertex(v));
    if (!overFace({a_, face}, p_b, {b_, v}, gap.normal, gap.length_m)) return false;
    gap.p_a = p_b - gap.length_m * gap.normal;
    return true;
  }

  bool vertexFace(int v, int face, PlacedGap& gap) const {
    Vec3 n;
    gap.p_a = a_.point(a_.polyhedron.vertex(v));
    if (!overFace({b_, face}, gap.p_a, {a_, v}, n, gap.length_m)) return false;
    gap.normal = -n;
    return true;
  }

  bool edgeEdge(int e1, int e2, PlacedGap& gap) const {
    const Edge& a = a_.polyhedron.edge(e1);
    const Edge& b = b_.polyhedron.edge(e2);
    if (a.left < 0 || b.left < 0) return false;  // segments have no sides: left to the walk
    const Vec3 d1 = a_.direction(a.direction);
    const Vec3 d2 = b_.direction(b.direction);
    const Vec3 across = d1.cross(d2);
    const double sine_squared = across.squaredNorm();
    if (sine_squared < kCrossingSine * kCrossingSine) return false;
    const Vec3 tail1 = a_.point(a_.polyhedron.vertex(a.tail));
    const Vec3 between = b_.point(b_.polyhedron.vertex(b.tail)) - tail1;
    const double inverse = 1.0 / sine_squared;
    const double s1 = dot(between.cross(d2), across) * inverse;
    const double s2 = dot(between.cross(d1), across) * inverse;
    const double inside = std::min(std::min(s1, a.length_m - s1), std::min(s2, b.length_m - s2));
    if (!(inside > noise_m_)) return false;
    const double sine = std::sqrt(sine_squared);
    const double along = dot(between, across);
    const Vec3 w = along > 0.0 ? across : -across;
    const double steepest =
        std::max(steeperSide(a, a_.directionBack(w)), steeperSide(b, -b_.directionBack(w)));
    if (!(steepest < -noise_slope_ * sine) || std::abs(along) < noise_m_ * sine) return false;
    gap.normal = w * (sine * inverse);
    gap.length_m = std::abs(along) * (sine * inverse);
    gap.p_a = tail1 + s1 * d1;
    return true;
  }

  bool edgeVertex(int e, int v, PlacedGap& gap) const {
    Vec3 w_A;
    const Vec3 p_b = b_.point(b_.polyhedron.vertex(v));
    if (!besideEdge(a_, e, p_b, w_A)) return false;
    const Vec3 w = a_.direction(w_A);
    const double steepest = std::max(steeperSide(a_.polyhedron.edge(e), w_A),
                                     steepestSpoke(b_.polyhedron, v, -b_.directionBack(w)));
    gap.p_a = p_b - w;
    return along(w, steepest, gap);
  }

  bool vertexEdge(int v, int e, PlacedGap& gap) const {
    Vec3 w_B;
    gap.p_a = a_.point(a_.polyhedron.vertex(v));
    if (!besideEdge(b_, e, gap.p_a, w_B)) return false;
    const Vec3 w = -b_.direction(w_B);
    const double steepest = std::max(steeperSide(b_.polyhedron.edge(e), w_B),
                                     steepestSpoke(a_.polyhedron, v, a_.directionBack(w)));
    return along(w, steepest, gap);
  }

  bool vertexVertex(int v1, int v2, PlacedGap& gap) const {
    gap.p_a = a_.point(a_.polyhedron.vertex(v1));
    const Vec3 w = b_.point(b_.polyhedron.vertex(v2)) - gap.p_a;
    const double steepest = std::max(steepestSpoke(a_.polyhedron, v1, a_.directionBack(w)),
                                     steepestSpoke(b_.polyhedron, v2, -b_.directionBack(w)));
    return along(w, steepest, gap);
  }

  static const Vec3& pointOf(const ConvexPolyhedron& polyhedron, Feature feature) {
    if (feature.kind == FeatureKind::kVertex) return polyhedron.vertex(feature.index);
    if (feature.kind == FeatureKind::kEdge) return polyhedron.vertex(polyhedron.edge(feature.index).tail);
    return polyhedron.vertex(polyhedron.faceVertices(feature.index)[0]);
  }

  // The way from A to B across the lines and planes of features, of any length.
  Vec3 wayAcross(FeaturePair features) const {
    const auto [a, b] = features;
    using enum FeatureKind;
    if (a.kind == kFace) return a_.direction(a_.polyhedron.plane(a.index).normal);
    if (b.kind == kFace) return -b_.direction(b_.polyhedron.plane(b.index).normal);
    const Vec3 between = b_.point(pointOf(b_.polyhedron, b)) - a_.point(pointOf(a_.polyhedron, a));
    if (a.kind == kVertex && b.kind == kVertex) return between;
    if (a.kind == kEdge && b.kind == kEdge) {
      const Vec3 across = a_.direction(a_.polyhedron.edge(a.index).direction)
                              .cross(b_.direction(b_.polyhedron.edge(b.index).direction));
      return dot(across, between) < 0.0 ? Vec3(-across) : across;
    }
    const Vec3 along = a.kind == kEdge ? a_.direction(a_.polyhedron.edge(a.index).direction)
                                       : b_.direction(b_.polyhedron.edge(b.index).direction);
    return between - dot(along, between) * along;
  }

  Vec3 between(int v1, int v2) const {
    return b_.point(b_.polyhedron.vertex(v2)) - a_.point(a_.polyhedron.vertex(v1));
  }

  // Up the steepest way off either feature along `w`, from A to B.
  FeaturePair upFrom(FeaturePair features, const Vec3& w) const {
    const WayOff off_a = steepestWayOff(a_.polyhedron, features.a, a_.directionBack(w));
    const WayOff off_b = steepestWayOff(b_.polyhedron, features.b, -b_.directionBack(w));
    if (off_a.slope >= off_b.slope && off_a.neighbour.index >= 0) return {off_a.neighbour, features.b};
    return off_b.neighbour.index >= 0 ? FeaturePair{features.a, off_b.neighbour} : features;
  }

  FeaturePair fromFaceVertex(int face, int v) const {
    const Vec3 p_A = a_.pointBack(b_.point(b_.polyhedron.vertex(v)));
    const std::span<const Plane> sides = a_.polyhedron.faceSides(face);
    std::size_t outermost = 0;
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (sides[i].signedDistance(p_A) < sides[outermost].signedDistance(p_A)) outermost = i;
    if (!(sides[outermost].signedDistance(p_A) > noise_m_))
      return {edgeFeature(a_.polyhedron.faceEdges(face)[outermost]), vertexFeature(v)};
    const Vec3 down_B = -b_.directionBack(a_.direction(a_.polyhedron.plane(face).normal));
    const Feature spoke = steepestWayOff(b_.polyhedron, vertexFeature(v), down_B).neighbour;
    if (spoke.index < 0) return {faceFeature(face), vertexFeature(v)};
    const Edge& edge = b_.polyhedron.edge(spoke.index);
    return {faceFeature(face), vertexFeature(edge.tail == v ? edge.head : edge.tail)};
  }

  FeaturePair fromEdgeVertex(int e, int v) const {
    const Edge& edge = a_.polyhedron.edge(e);
    const Vec3 from_tail = a_.pointBack(b_.point(b_.polyhedron.vertex(v))) - a_.polyhedron.vertex(edge.tail);
    const double s = dot(edge.direction, from_tail);
    if (!(s > noise_m_)) return {vertexFeature(edge.tail), vertexFeature(v)};
    if (!(edge.length_m - s > noise_m_)) return {vertexFeature(edge.head), vertexFeature(v)};
    return upFrom({edgeFeature(e), vertexFeature(v)}, a_.direction(from_tail - s * edge.direction));
  }

  FeaturePair fromEdgeEdge(int e1, int e2) const {
    const Edge& a = a_.polyhedron.edge(e1);
    const Edge& b = b_.polyhedron.edge(e2);
    const FeaturePair here{edgeFeature(e1), edgeFeature(e2)};
    const Vec3 d1 = a_.direction(a.direction);
    const Vec3 d2 = b_.direction(b.direction);
    const Vec3 across = d1.cross(d2);
    const double sine_squared = across.squaredNorm();
    if (sine_squared < kCrossingSine * kCrossingSine) return here;
    const Vec3 tails = between(a.tail, b.tail);
    const double s1 = dot(tails.cross(d2), across) / sine_squared;
    const double s2 = dot(tails.cross(d1), across) / sine_squared;
    const double beyond1 = std::max(-s1, s1 - a.length_m);
    const double beyond2 = std::max(-s2, s2 - b.length_m);
    if (std::max(beyond1, beyond2) > -noise_m_) {
      if (beyond1 > beyond2) return {vertexFeature(s1 < 0.5 * a.length_m ? a.tail : a.head), here.b};
      return {here.a, vertexFeature(s2 < 0.5 * b.length_m ? b.tail : b.head)};
    }
    const Vec3 w = dot(tails, across) > 0.0 ? across : -across;
    const FeaturePair next = upFrom(here, w);
    // A face and an edge: the edge's end that is lower over the face.
    if (next.a.kind == FeatureKind::kFace) {
      const double rises = dot(a_.direction(a_.polyhedron.plane(next.a.index).normal), d2);
      return {next.a, vertexFeature(rises > 0.0 ? b.tail : b.head)};
    }
    if (next.b.kind == FeatureKind::kFace) {
      const double rises = dot(b_.direction(b_.polyhedron.plane(next.b.index).normal), d1);
      return {vertexFeature(rises > 0.0 ? a.tail : a.head), next.b};
    }
    return next;
  }

  // A vertex, at `p`, over a face with normal `n`.
  struct PlacedFeature {
    const PlacedPolyhedron& body;
    int index;
  };
  bool overFace(PlacedFeature face, const Vec3& p, PlacedFeature vertex, Vec3& n, double& height) const {
    const PlacedPolyhedron& a = face.body;
    const Plane& plane = a.polyhedron.plane(face.index);
    const Vec3 p_A = a.pointBack(p);
    height = plane.signedDistance(p_A);
    double inside = height;
    for (const Plane& side : a.polyhedron.faceSides(face.index))
      inside = std::min(inside, side.signedDistance(p_A));
    if (!(inside > noise_m_)) return false;
    n = a.direction(plane.normal);
    return steepestSpoke(vertex.body.polyhedron, vertex.index, -vertex.body.directionBack(n)) < -noise_slope_;
  }

  // The foot of `p` on an edge of `a`, inside its ends: the way from there to `p`, in the frame of `a`.
  bool besideEdge(const PlacedPolyhedron& a, int e, const Vec3& p, Vec3& w_A) const {
    const Edge& edge = a.polyhedron.edge(e);
    if (edge.left < 0) return false;
    const Vec3 from_tail = a.pointBack(p) - a.polyhedron.vertex(edge.tail);
    const double s = dot(edge.direction, from_tail);
    if (!(std::min(s, edge.length_m - s) > noise_m_)) return false;
    w_A = from_tail - s * edge.direction;
    w_A -= dot(edge.direction, w_A) * edge.direction;  // of a short way rounding would leave a slope
    return true;
  }

  // The direction w between the witnesses is off by rounding, noise / |w|: so are the slopes along it.
  bool along(const Vec3& w, double steepest, PlacedGap& gap) const {
    const double distance = w.norm();
    if (!(steepest < -(noise_slope_ * distance + noise_m_)) || distance < noise_m_) return false;
    gap.length_m = distance;
    gap.normal = w / distance;
    return true;
  }

  const PlacedPolyhedron& a_;
  const PlacedPolyhedron& b_;
  double noise_m_, noise_slope_;
};

}  // namespace

bool certifiedClosest(const PlacedPolyhedron& a, const PlacedPolyhedron& b, FeaturePair features,
                      double noise_m, PlacedGap& gap) {
  return WarmPair(a, b, noise_m).proves(features, gap);
}

PairsInPlace findCertifiedClosest(const PlacedPolyhedron& a, const PlacedPolyhedron& b, double noise_m,
                                  FeaturePair& features, PlacedGap& gap) {
  const WarmPair pair(a, b, noise_m);
  PairsInPlace tried;
  bool remembered = isOf(a.polyhedron, features.a) && isOf(b.polyhedron, features.b);
  if (!remembered) features = facingFeatures(a, b);
  while (tried.visited < kMostTried) {
    ++tried.visited;
    tried.found = pair.proves(features, gap);
    if (tried.found) break;
    if (remembered && pair.faceAway(features)) {
      features = facingFeatures(a, b);
    } else {
      const FeaturePair next = pair.leadsTo(features);
      if (next == features) break;
      features = next;
    }
    remembered = false;
  }
  return tried;
}

FeaturePair facingFeatures(const PlacedPolyhedron& a, const PlacedPolyhedron& b) {
  const Vec3 between = b.point(b.polyhedron.center()) - a.point(a.polyhedron.center());
  return {vertexFeature(a.polyhedron.support(a.directionBack(between))),
          vertexFeature(b.polyhedron.support(-b.directionBack(between)))};
}

bool certifiedInside(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m) {
  const auto [a, b] = answer.features;
  const auto within = [noise_m](const ConvexPolyhedron& polyhedron, int face, const Vec3& p) {
    double inside = std::numeric_limits<double>::infinity();
    for (const Plane& side : polyhedron.faceSides(face)) inside = std::min(inside, side.signedDistance(p));
    return inside > noise_m;
  };
  if (a.kind == FeatureKind::kFace) return within(pair.a, a.index, answer.p_b);
  if (b.kind == FeatureKind::kFace) return within(pair.b, b.index, pair.toB(answer.p_a));
  if (a.kind != FeatureKind::kEdge || b.kind != FeatureKind::kEdge) return false;
  const Edge& e1 = pair.a.edge(a.index);
  const Edge& e2 = pair.b.edge(b.index);
  const double s1 = dot(e1.direction, answer.p_a - pair.a.vertex(e1.tail));
  const double s2 = dot(e2.direction, pair.toB(answer.p_b) - pair.b.vertex(e2.tail));
  return std::min(std::min(s1, e1.length_m - s1), std::min(s2, e2.length_m - s2)) > noise_m;
}

bool certifiedAlone(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m) {
  const auto [a, b] = answer.features;
  const double noise_slope = noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge());
  const Vec3 minus_n_B = -pair.directionToB(answer.normal);
  if (a.kind == FeatureKind::kFace) return steepestSpoke(pair.b, b.index, minus_n_B) < -noise_slope;
  if (b.kind == FeatureKind::kFace) return steepestSpoke(pair.a, a.index, answer.normal) < -noise_slope;
  if (a.kind != FeatureKind::kEdge || b.kind != FeatureKind::kEdge) return false;
  const Edge& e1 = pair.a.edge(a.index);
  const Edge& e2 = pair.b.edge(b.index);
  return e1.left >= 0 && e2.left >= 0 &&
         std::max(steeperSide(e1, answer.normal), steeperSide(e2, minus_n_B)) < -noise_slope;
}

}  // namespace carom
