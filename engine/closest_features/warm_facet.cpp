#include "engine/closest_features/warm_facet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/closest_features/two_discs.h"

namespace carom {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostFacets = 8;          // on the way down: what has moved farther is better begun anew
constexpr std::size_t kMostSides = 16;  // of a facet: rounder ones are left to the polytope

// A side of a facet: an edge of one body, and the vertex of the other that the edge's points are taken from
// or less by. As seen from a point of the facet's plane.
struct Side {
  Vec3 inwards;     // unit, in the plane
  double inside_m;  // how far the point is inside
  int edge;
  int vertex;
  bool edge_of_a;
};

struct Sides {
  std::array<Side, kMostSides> all;
  std::size_t count = 0;

  void add(const Side& side) { all[count++] = side; }
  std::size_t nearest() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count; ++i)
      if (all[i].inside_m < all[best].inside_m) best = i;
    return best;
  }
  /// Which one a side of the neighbour is; `count` if none.
  std::size_t placeOf(const Side& side) const {
    std::size_t i = 0;
    while (i < count &&
           (all[i].edge != side.edge || all[i].vertex != side.vertex || all[i].edge_of_a != side.edge_of_a))
      ++i;
    return i;
  }
  /// The radius of the largest disc in the facet that touches a side beside the point; not positive where the
  /// point is not beside it.
  double discAt(std::size_t side) const {
    const Side& touched = all[side];
    double least = kInfinity;
    for (std::size_t i = 0; i < count; ++i) {
      if (i == side) continue;
      const double narrows = 1.0 - touched.inwards.dot(all[i].inwards);
      least = std::min(least, (all[i].inside_m - touched.inside_m) / narrows);
    }
    return least + touched.inside_m;
  }
};

class Descent {
 public:
  Descent(const PolyhedronPair& pair, double noise_m) : pair_(pair), noise_m_(noise_m) {}

  std::optional<WarmFacet> from(FeaturePair features) const {
    std::optional<MinimumTranslation> facet = facetOf(features);
    if (!facet) return std::nullopt;
    WarmFacet found{*facet, false};
    for (int i = 0; i < kMostFacets; ++i) {
      const double depth = -found.gap.gap_m;
      Sides sides;
      if (!(depth > noise_m_) || !findSides(found.gap, depth * found.gap.normal, sides)) break;
      const std::size_t nearest = sides.nearest();
      const Side& side = sides.all[nearest];
      const bool holds_foot = side.inside_m >= 0.0;
      double half_tangent = kInfinity;
      if (holds_foot) {
        half_tangent = coneLeft(found.gap.normal, depth);
        found.proven = side.inside_m >= depth * half_tangent;
        if (found.proven || !(half_tangent <= 1.0)) break;
      }
      facet = facetAcross(found.gap, side);
      if (!facet) break;
      if (facet->gap_m > found.gap.gap_m) {
        found.gap = *facet;
        continue;
      }
      found.proven = holds_foot && provenByTwo(found.gap, sides, nearest, *facet, half_tangent);
      break;
    }
    return found;
  }

 private:
  std::optional<MinimumTranslation> facetOf(FeaturePair features) const {
    const auto& [a, b] = features;
    if (a.kind == FeatureKind::kFace && b.kind == FeatureKind::kVertex)
      return gapOverFaceOfA(pair_, a.index, b.index);
    if (a.kind == FeatureKind::kVertex && b.kind == FeatureKind::kFace)
      return gapOverFaceOfB(pair_, b.index, a.index);
    if (a.kind != FeatureKind::kEdge || b.kind != FeatureKind::kEdge) return std::nullopt;
    const Edge& edge = pair_.a.edge(a.index);
    if (edge.left < 0) return std::nullopt;
    const Vec3 outward = pair_.a.plane(edge.left).normal + pair_.a.plane(edge.right).normal;
    if (const auto facet = facetOfEdges(a.index, b.index, outward)) return facet;
    return facetAround(outward, edge.tail, pair_.b.edge(b.index).tail);
  }

  // None where the edges' arcs do not cross on the Gauss map: other vertices support M along their normal.
  std::optional<MinimumTranslation> facetOfEdges(int edge_a, int edge_b, const Vec3& outward) const {
    const auto across = gapAcrossEdges(pair_, edge_a, edge_b, outward);
    if (!across) return std::nullopt;
    const Vec3 between =
        pair_.toA(pair_.b.vertex(pair_.b.edge(edge_b).tail)) - pair_.a.vertex(pair_.a.edge(edge_a).tail);
    if (std::abs(across->normal.dot(between) - across->gap_m) > noise_m_) return std::nullopt;
    return across;
  }

  // Some facet at M's corner in a direction, between vertices climbed to from these.
  std::optional<MinimumTranslation> facetAround(const Vec3& direction, int start_a, int start_b) const {
    const int v = pair_.a.support(direction, start_a);
    const int face = faceTowards(pair_.a, v, direction);
    if (face < 0) return std::nullopt;
    return gapOverFaceOfA(pair_, face, pair_.b.support(-pair_.directionToB(direction), start_b));
  }

  // The facet's sides as seen from a point of its plane; false if there are too many.
  bool findSides(const MinimumTranslation& facet, const Vec3& point, Sides& sides) const {
    const auto& [a, b] = facet.features;
    if (a.kind == FeatureKind::kFace) {
      const Vec3 on_a = point + pair_.toA(pair_.b.vertex(b.index));
      return findSidesOfFace(pair_.a, a.index, on_a, b.index, true, sides);
    }
    if (b.kind == FeatureKind::kFace) {
      const Vec3 on_b = pair_.toB(pair_.a.vertex(a.index) - point);
      return findSidesOfFace(pair_.b, b.index, on_b, a.index, false, sides);
    }
    const Edge& edge_a = pair_.a.edge(a.index);
    const Edge& edge_b = pair_.b.edge(b.index);
    const Vec3& along_a = edge_a.direction;
    const Vec3 along_b = pair_.directionToA(edge_b.direction);
    const double cosine = along_a.dot(along_b);
    const double sine = along_a.cross(along_b).norm();
    const Vec3 from_tails = point - pair_.a.vertex(edge_a.tail) + pair_.toA(pair_.b.vertex(edge_b.tail));
    const Vec3 from_tail_a = (along_a - cosine * along_b) / sine;
    const Vec3 from_tail_b = (cosine * along_a - along_b) / sine;
    const double in_a = from_tail_a.dot(from_tails);
    const double in_b = from_tail_b.dot(from_tails);
    sides.add({from_tail_a, in_a, b.index, edge_a.tail, false});
    sides.add({-from_tail_a, sine * edge_a.length_m - in_a, b.index, edge_a.head, false});
    sides.add({from_tail_b, in_b, a.index, edge_b.tail, true});
    sides.add({-from_tail_b, sine * edge_b.length_m - in_b, a.index, edge_b.head, true});
    return true;
  }

  bool findSidesOfFace(const ConvexPolyhedron& body, int face, const Vec3& point, int vertex, bool of_a,
                       Sides& sides) const {
    const std::span<const Plane> planes = body.faceSides(face);
    const std::span<const int> edges = body.faceEdges(face);
    if (planes.size() > kMostSides) return false;
    for (std::size_t i = 0; i < planes.size(); ++i)
      sides.add({inM(planes[i].normal, of_a), planes[i].signedDistance(point), edges[i], vertex, of_a});
    return true;
  }

  // A direction of one body as one of M, in the frame of A.
  Vec3 inM(const Vec3& direction, bool of_a) const {
    return of_a ? direction : Vec3(-pair_.directionToA(direction));
  }

  // The facet on the other side: along the arc of the side's edge, away from the facet's normal, the vertex
  // goes on supporting M until an edge of its body crosses the arc, or the arc ends at a face.
  std::optional<MinimumTranslation> facetAcross(const MinimumTranslation& facet, const Side& side) const {
    const ConvexPolyhedron& body = side.edge_of_a ? pair_.a : pair_.b;
    const ConvexPolyhedron& other = side.edge_of_a ? pair_.b : pair_.a;
    const Edge& edge = body.edge(side.edge);
    if (edge.left < 0) return std::nullopt;
    const Vec3 left = inM(body.plane(edge.left).normal, side.edge_of_a);
    const Vec3 right = inM(body.plane(edge.right).normal, side.edge_of_a);
    const bool to_left = left.dot(side.inwards) < right.dot(side.inwards);
    const Vec3& end = to_left ? left : right;
    const int crossing = firstAcross(facet, side, other, end);
    if (crossing >= 0)
      return side.edge_of_a ? facetOfEdges(side.edge, crossing, facet.normal + end)
                            : facetOfEdges(crossing, side.edge, facet.normal + end);
    const int face = to_left ? edge.left : edge.right;
    return side.edge_of_a ? gapOverFaceOfA(pair_, face, side.vertex)
                          : gapOverFaceOfB(pair_, face, side.vertex);
  }

  // Of the edges at the side's vertex, the one that first rises above it from the facet's normal to `end`; -1
  // if none does.
  int firstAcross(const MinimumTranslation& facet, const Side& side, const ConvexPolyhedron& other,
                  const Vec3& end) const {
    const auto inOther = [&](const Vec3& n) { return side.edge_of_a ? Vec3(-pair_.directionToB(n)) : n; };
    const Vec3 from = inOther(facet.normal);
    const Vec3 to = inOther(end);
    const Feature& feature_of_other = side.edge_of_a ? facet.features.b : facet.features.a;
    int crossing = -1;
    double first = 1.0;
    for (const Spoke& spoke : other.spokes(side.vertex)) {
      if (edgeFeature(spoke.edge) == feature_of_other) continue;  // level with the facet, and falls
      const double at_end = to.dot(spoke.direction);
      if (!(at_end > 0.0)) continue;
      const double at_start = std::min(0.0, from.dot(spoke.direction));
      const double share = at_start / (at_start - at_end);
      if (share >= first) continue;
      first = share;
      crossing = spoke.edge;
    }
    return crossing;
  }

  // tan(t0 / 2) of the angle from the normal within which the balls leave all directions; infinite where they
  // prove nothing. Their support, radius - n . between, is D or more but in a cone about `between`.
  double coneLeft(const Vec3& normal, double depth) const {
    const InnerBall& ball_a = pair_.a.innerBall();
    const InnerBall& ball_b = pair_.b.innerBall();
    const Vec3 between = pair_.toA(ball_b.center) - ball_a.center;
    const double far = between.norm();
    const double reach = ball_a.radius_m + ball_b.radius_m - depth;
    if (reach >= far) return 0.0;
    if (!(reach > -far)) return kInfinity;
    const double cos_cone = reach / far;
    const double sin_cone = std::sqrt(1.0 - cos_cone * cos_cone);
    const double cos_off = normal.dot(between) / far;
    const double sin_off = normal.cross(between).norm() / far;
    const double sine = sin_off * cos_cone + cos_off * sin_cone;
    const double cosine = cos_off * cos_cone - sin_off * sin_cone;
    return sine > 0.0 ? sine / (1.0 + cosine) : kInfinity;
  }

  // Together with the facet across the side that is nearest to the foot.
  bool provenByTwo(const MinimumTranslation& facet, const Sides& sides, std::size_t nearest,
                   const MinimumTranslation& across, double half_tangent) const {
    const Side& side = sides.all[nearest];
    TwoDiscs discs{.depth_m = -facet.gap_m, .near_m = side.inside_m, .radius_m = sides.discAt(nearest)};
    Sides of_across;
    const Vec3 beside_foot = discs.depth_m * facet.normal - discs.near_m * side.inwards;
    if (!findSides(across, beside_foot, of_across)) return false;
    const std::size_t shared = of_across.placeOf(side);
    if (shared == of_across.count) return false;
    discs.across_m = of_across.discAt(shared);
    discs.lean_cosine = facet.normal.dot(across.normal);
    discs.lean_tangent = -side.inwards.dot(across.normal) / discs.lean_cosine;
    return reachWithin(half_tangent, discs);
  }

  const PolyhedronPair& pair_;
  double noise_m_;
};

}  // namespace

std::optional<WarmFacet> nearestFacet(const PolyhedronPair& pair, FeaturePair features, double noise_m) {
  return Descent(pair, noise_m).from(features);
}

}  // namespace carom
