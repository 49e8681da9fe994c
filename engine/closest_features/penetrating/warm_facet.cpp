#include "engine/closest_features/penetrating/warm_facet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "engine/closest_features/penetrating/cap_cover.h"

namespace carom {
namespace {

constexpr int kMostFacets = 16;  // on the way down: what has moved farther is better begun anew

// An edge of M: an edge of one body, and the vertex of the other that the edge's points are taken from or
// less by. On the Gauss map it is an arc between facets.
struct Arc {
  int edge;
  int vertex;
  bool edge_of_a;
};

// A side of a facet.
struct Side : Arc {
  Vec3 inwards;            // unit, in the facet's plane
  double inside_m;         // how far the foot of the origin is inside
  int corner_a, corner_b;  // the vertices whose difference is the corner at which it begins
};

// In their order around the facet.
struct Sides {
  std::array<Side, CapCover::kMostCorners> all;
  std::size_t count = 0;

  void add(const Side& side) { all[count++] = side; }
  std::span<const Side> used() const { return {all.data(), count}; }
  const Side& nearest() const {
    return *std::min_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count),
                             [](const Side& s, const Side& t) { return s.inside_m < t.inside_m; });
  }
};

class Descent {
 public:
  Descent(const PolyhedronPair& pair, double noise_m) : pair_(pair), noise_m_(noise_m) {}

  std::optional<WarmFacet> from(FeaturePair features) const {
    std::optional<MinimumTranslation> facet = facetOf(features);
    if (!facet) return std::nullopt;
    std::optional<MinimumTranslation> best;
    for (int i = 0; i < kMostFacets; ++i) {
      std::optional<MinimumTranslation> next;
      Sides sides;
      if (findSides(*facet, sides)) {
        const Side& nearest = sides.nearest();
        if (nearest.inside_m < 0.0) {
          next = facetAcross(*facet, nearest);
        } else {
          CapCover::Lower lower;
          const CapCover::Outcome outcome = prove(*facet, sides, lower);
          if (outcome == CapCover::Outcome::kCovered) return WarmFacet{*facet, true, false, nearest.inside_m};
          if (outcome == CapCover::Outcome::kLower) next = facetBelow(lower);
        }
      }
      if (i == 0 && isStale(*facet)) return WarmFacet{*facet, false, true, 0.0};
      if (!best || facet->gap_m > best->gap_m) best = facet;
      if (!next || !(next->gap_m > facet->gap_m + noise_m_)) break;
      facet = next;
    }
    return WarmFacet{*best, false, false, 0.0};
  }

 private:
  // M lies within a ball of the sum of the bodies' radii, about the difference of their middles. A facet that
  // is farther than that radius is on the far side of the ball, where the nearest one never is.
  bool isStale(const MinimumTranslation& facet) const {
    return -facet.gap_m > pair_.a.radius() + pair_.b.radius();
  }

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

  // None where the edges' arcs do not cross on the Gauss map: a face beside one of them rises along their
  // common perpendicular.
  std::optional<MinimumTranslation> facetOfEdges(int edge_a, int edge_b, const Vec3& outward) const {
    const Edge& a = pair_.a.edge(edge_a);
    const Edge& b = pair_.b.edge(edge_b);
    const Vec3 along_b = pair_.directionToA(b.direction);
    const auto across = commonPerpendicular(a.direction, along_b);
    if (!across) return std::nullopt;
    const Vec3 n = across->towards(outward);
    if (!supports(pair_.a, a, n) || !supports(pair_.b, b, -pair_.directionToB(n))) return std::nullopt;
    const Vec3& tail = pair_.a.vertex(a.tail);
    const Vec3 between = pair_.toA(pair_.b.vertex(b.tail)) - tail;
    const double gap = dot(n, between);
    const Vec3 foot = tail + across->footAlong(between, along_b) * a.direction;
    return MinimumTranslation{gap, n, {edgeFeature(edge_a), edgeFeature(edge_b)}, foot, foot + gap * n};
  }

  // Whether an edge across a direction is the farthest along it: both faces fall from there, and face it
  // (both of a flat edge are level on the far side too).
  static bool supports(const ConvexPolyhedron& body, const Edge& edge, const Vec3& direction) {
    if (edge.left < 0) return true;
    const double left = dot(edge.into_left, direction), right = dot(edge.into_right, direction);
    if (std::max(left, right) > kLevelSlope) return false;
    const bool flat = std::min(left, right) >= -kLevelSlope;
    return !flat || dot(direction, body.plane(edge.left).normal + body.plane(edge.right).normal) > 0.0;
  }

  // Some facet at M's corner in a direction, between vertices climbed to from these.
  std::optional<MinimumTranslation> facetAround(const Vec3& direction, int start_a, int start_b) const {
    const int v = pair_.a.support(direction, start_a);
    const int face = faceTowards(pair_.a, v, direction);
    if (face < 0) return std::nullopt;
    return gapOverFaceOfA(pair_, face, pair_.b.support(-pair_.directionToB(direction), start_b));
  }

  // The facet's sides as seen from the foot of the origin; false if there are too many, or it has no depth.
  bool findSides(const MinimumTranslation& facet, Sides& sides) const {
    if (!(-facet.gap_m > noise_m_)) return false;
    const auto& [a, b] = facet.features;
    const Vec3 foot = -facet.gap_m * facet.normal;
    if (a.kind == FeatureKind::kFace) {
      const Vec3 on_a = foot + pair_.toA(pair_.b.vertex(b.index));
      return findSidesOfFace(pair_.a, a.index, on_a, b.index, true, sides);
    }
    if (b.kind == FeatureKind::kFace) {
      const Vec3 on_b = pair_.toB(pair_.a.vertex(a.index) - foot);
      return findSidesOfFace(pair_.b, b.index, on_b, a.index, false, sides);
    }
    const Edge& edge_a = pair_.a.edge(a.index);
    const Edge& edge_b = pair_.b.edge(b.index);
    const Vec3& along_a = edge_a.direction;
    const Vec3 along_b = pair_.directionToA(edge_b.direction);
    const Vec3 beside_b = along_b.cross(facet.normal);
    const double sine_signed = dot(beside_b, along_a);
    const double sine = std::abs(sine_signed);
    const Vec3 from_tail_a = std::copysign(1.0, sine_signed) * beside_b;
    const Vec3 from_tail_b = std::copysign(1.0, sine_signed) * along_a.cross(facet.normal);
    const Vec3 from_tails = foot - pair_.a.vertex(edge_a.tail) + pair_.toA(pair_.b.vertex(edge_b.tail));
    const double in_a = dot(from_tail_a, from_tails);
    const double in_b = dot(from_tail_b, from_tails);
    const double to_head_a = sine * edge_a.length_m - in_a;
    const double to_head_b = sine * edge_b.length_m - in_b;
    sides.add({{b.index, edge_a.tail, false}, from_tail_a, in_a, edge_a.tail, edge_b.tail});
    sides.add({{a.index, edge_b.head, true}, -from_tail_b, to_head_b, edge_a.tail, edge_b.head});
    sides.add({{b.index, edge_a.head, false}, -from_tail_a, to_head_a, edge_a.head, edge_b.head});
    sides.add({{a.index, edge_b.tail, true}, from_tail_b, in_b, edge_a.head, edge_b.tail});
    return true;
  }

  bool findSidesOfFace(const ConvexPolyhedron& body, int face, const Vec3& point, int vertex, bool of_a,
                       Sides& sides) const {
    const std::span<const Plane> planes = body.faceSides(face);
    const std::span<const int> edges = body.faceEdges(face);
    const std::span<const int> corners = body.faceVertices(face);
    if (planes.size() > sides.all.size()) return false;
    for (std::size_t i = 0; i < planes.size(); ++i)
      sides.add({{edges[i], vertex, of_a},
                 inM(planes[i].normal, of_a),
                 planes[i].signedDistance(point),
                 of_a ? corners[i] : vertex,
                 of_a ? vertex : corners[i]});
    return true;
  }

  // A direction of one body as one of M, in the frame of A.
  Vec3 inM(const Vec3& direction, bool of_a) const {
    return of_a ? direction : Vec3(-pair_.directionToA(direction));
  }

  // The facet on the other side of this side.
  std::optional<MinimumTranslation> facetAcross(const MinimumTranslation& facet, const Side& side) const {
    const Edge& edge = (side.edge_of_a ? pair_.a : pair_.b).edge(side.edge);
    if (edge.left < 0) return std::nullopt;
    const bool to_left = dot(arcEnd(side, true), side.inwards) < dot(arcEnd(side, false), side.inwards);
    return facetAlong(facet.normal, side, to_left, side.edge_of_a ? facet.features.b : facet.features.a);
  }

  // A facet where M's support is less than at a corner: away from the corner to the next arc, and down along
  // that.
  std::optional<MinimumTranslation> facetBelow(const CapCover::Lower& lower) const {
    const Vec3 w = pair_.a.vertex(lower.a) - pair_.toA(pair_.b.vertex(lower.b));
    const Vec3 away = dot(lower.direction, w) * lower.direction - w;
    double first = std::numeric_limits<double>::infinity();
    Arc arc{-1, -1, false};
    const auto findFirst = [&](const ConvexPolyhedron& body, int v, const Vec3& from, const Vec3& to,
                               int other, bool of_a) {
      for (const Spoke& spoke : body.spokes(v)) {
        const double rise = dot(to, spoke.direction);
        if (!(rise > 0.0)) continue;
        const double at = std::max(0.0, -dot(from, spoke.direction)) / rise;
        if (at >= first) continue;
        first = at;
        arc = {spoke.edge, other, of_a};
      }
    };
    findFirst(pair_.a, lower.a, lower.direction, away, lower.b, true);
    findFirst(pair_.b, lower.b, -pair_.directionToB(lower.direction), -pair_.directionToB(away), lower.a,
              false);
    if (arc.edge < 0 || (arc.edge_of_a ? pair_.a : pair_.b).edge(arc.edge).left < 0) return std::nullopt;
    const Vec3 start = (lower.direction + first * away).normalized();
    const Vec3 down = dot(start, w) * start - w;
    const bool to_left = dot(down, arcEnd(arc, true)) > dot(down, arcEnd(arc, false));
    return facetAlong(start, arc, to_left, {});
  }

  // The end of an arc: the normal of the face on the edge's left, or right.
  Vec3 arcEnd(const Arc& arc, bool left) const {
    const ConvexPolyhedron& body = arc.edge_of_a ? pair_.a : pair_.b;
    const Edge& edge = body.edge(arc.edge);
    return inM(body.plane(left ? edge.left : edge.right).normal, arc.edge_of_a);
  }

  // From a direction on an arc towards one of its ends, the vertex goes on supporting M until an edge of its
  // body crosses the arc, or the arc ends at a face.
  std::optional<MinimumTranslation> facetAlong(const Vec3& start, const Arc& arc, bool to_left,
                                               Feature level) const {
    const Vec3 end = arcEnd(arc, to_left);
    if (const std::optional<int> crossing = firstAcross(start, end, arc, level))
      return arc.edge_of_a ? facetOfEdges(arc.edge, *crossing, start + end)
                           : facetOfEdges(*crossing, arc.edge, start + end);
    const Edge& edge = (arc.edge_of_a ? pair_.a : pair_.b).edge(arc.edge);
    const int face = to_left ? edge.left : edge.right;
    return arc.edge_of_a ? gapOverFaceOfA(pair_, face, arc.vertex) : gapOverFaceOfB(pair_, face, arc.vertex);
  }

  // Of the edges at the arc's vertex, the one that first rises above it from `start` to `end`, if any does.
  // `level`: one that is level with the start, and falls.
  std::optional<int> firstAcross(const Vec3& start, const Vec3& end, const Arc& arc, Feature level) const {
    const ConvexPolyhedron& other = arc.edge_of_a ? pair_.b : pair_.a;
    const auto inOther = [&](const Vec3& n) { return arc.edge_of_a ? Vec3(-pair_.directionToB(n)) : n; };
    const Vec3 from = inOther(start);
    const Vec3 to = inOther(end);
    std::optional<int> crossing;
    double first = 1.0;
    for (const Spoke& spoke : other.spokes(arc.vertex)) {
      if (edgeFeature(spoke.edge) == level) continue;
      const double at_end = dot(to, spoke.direction);
      if (!(at_end > 0.0)) continue;
      const double at_start = std::min(0.0, dot(from, spoke.direction));
      const double share = at_start / (at_start - at_end);
      if (share >= first) continue;
      first = share;
      crossing = spoke.edge;
    }
    return crossing;
  }

  // Whether no facet is nearer than this one, which holds its foot.
  CapCover::Outcome prove(const MinimumTranslation& facet, const Sides& sides, CapCover::Lower& lower) const {
    const double depth = -facet.gap_m;
    const DirectionCap left = leftByBalls(depth);
    if (left.isEmpty() || coversAlone(facet, sides, left)) return CapCover::Outcome::kCovered;
    CapCover cover(pair_, facet.normal, depth, noise_m_, left);
    for (const Side& side : sides.used()) {
      const double scale = 1.0 / (depth * depth + side.inside_m * side.inside_m);
      const double cosine = scale * (depth * depth - side.inside_m * side.inside_m);
      const double sine = 2.0 * scale * depth * side.inside_m;
      cover.addCorner(side.corner_a, side.corner_b, cosine * facet.normal - sine * side.inwards);
    }
    const CapCover::Outcome outcome = cover.cover();
    lower = cover.lower();
    return outcome;
  }

  // Whether the facet's corners cover a cap: it holds the normal, but none of the directions in which the
  // rims of their caps cross, the angle t from the normal across each side, with tan(t / 2) = inside / depth.
  static bool coversAlone(const MinimumTranslation& facet, const Sides& sides, const DirectionCap& cap) {
    const double depth = -facet.gap_m;
    const double along = dot(facet.normal, cap.point);
    if (!(along > cap.level_m)) return false;
    const double outside = cap.level_m - kCapMargin * (std::abs(along) + std::abs(cap.level_m));
    const double low = depth * depth * (along - outside), high = along + outside;
    return std::all_of(sides.used().begin(), sides.used().end(), [&](const Side& side) {
      const double inside = side.inside_m;
      return low - inside * (inside * high + 2.0 * depth * dot(side.inwards, cap.point)) < 0.0;
    });
  }

  // The balls' support, radius - n . between, is the depth or more but in a cap about `between`.
  DirectionCap leftByBalls(double depth) const {
    const InnerBall& ball_a = pair_.a.innerBall();
    const InnerBall& ball_b = pair_.b.innerBall();
    return {pair_.toA(ball_b.center) - ball_a.center, ball_a.radius_m + ball_b.radius_m - depth};
  }

  const PolyhedronPair& pair_;
  double noise_m_;
};

}  // namespace

std::optional<WarmFacet> nearestFacet(const PolyhedronPair& pair, FeaturePair features, double noise_m) {
  return Descent(pair, noise_m).from(features);
}

}  // namespace carom
