#include "engine/closest_features/vclip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "engine/closest_features/feature_distance.h"
#include "engine/closest_features/penetration.h"
#include "engine/closest_features/v_region.h"

namespace carom {
namespace {

// Cores closer than this, relative to their size, have no trustworthy direction between their witnesses; the
// separating axes give it.
constexpr double kNoDirection = 1e-9;
// Distances below this relative to the size are touching.
constexpr double kTouching = 1e-14;
// A distance that may be wrong by more than this, relative to the size, is looked at again.
constexpr double kSlack = 1e-12;
// A slope s gains d s^2 / 2 at distance d, which rounding hides up to s^2 = 1e-16 * size / d or so. Features
// this close to level at a distance of the size, and closer in proportion, are looked at together.
constexpr double kLevelSine = 1e-6;
// Edges that cross at a larger angle have a well-defined common perpendicular.
constexpr double kCrossingSine = 1e-3;
// Relative to the size: the direction between witnesses closer than this is blurred by rounding.
constexpr double kShortDistance = 1e-6;

// Vertices that face each other: far along the line between the bodies' first vertices.
FeaturePair coldSeed(const PolyhedronPair& pair) {
  const Vec3 toward_b = pair.toA(pair.b.vertex(0)) - pair.a.vertex(0);
  const int va = pair.a.support(toward_b);
  const int vb = pair.b.support(-(pair.R_AB.transpose() * toward_b));
  return {vertexFeature(va), vertexFeature(vb)};
}

// A point outside A whose way to a point of A's surface begins inside A: the face through which that way
// enters A, or none when the point is inside. Frame of A.
std::optional<int> entryFace(const ConvexPolyhedron& a, const Vec3& from, const Vec3& to) {
  std::optional<int> entry;
  double latest = -1.0;
  for (int f = 0; f < a.faceCount(); ++f) {
    const double h_from = a.plane(f).signedDistance(from);
    if (h_from <= 0.0) continue;
    const double h_to = std::min(a.plane(f).signedDistance(to), 0.0);
    const double t = h_from / (h_from - h_to);
    if (t > latest) {
      latest = t;
      entry = f;
    }
  }
  return entry;
}

// The feature and what of the body's surface touches it and is almost level across `n`: edges and faces at
// its vertices. More of them than fit stay out; they only serve to find a shorter way.
struct LevelNeighbours {
  LevelNeighbours(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& n, double level_sine) {
    const auto visitVertex = [&](int v) {
      for (int e : polyhedron.vertexEdges(v)) {
        const Edge& edge = polyhedron.edge(e);
        if (std::abs(edge.direction.dot(n)) > level_sine) continue;
        add(edgeFeature(e));
        for (int f : {edge.left, edge.right})
          if (f >= 0 && polyhedron.plane(f).normal.cross(n).norm() <= level_sine) add(faceFeature(f));
      }
    };
    add(feature);
    switch (feature.kind) {
      case FeatureKind::kVertex:
        visitVertex(feature.index);
        break;
      case FeatureKind::kEdge:
        visitVertex(polyhedron.edge(feature.index).tail);
        visitVertex(polyhedron.edge(feature.index).head);
        break;
      case FeatureKind::kFace:
        for (int v : polyhedron.faceVertices(feature.index)) visitVertex(v);
        break;
    }
  }

  std::span<const Feature> all() const { return {features_.data(), count_}; }

 private:
  void add(Feature feature) {
    const std::span<const Feature> known = all();
    if (count_ < features_.size() && std::find(known.begin(), known.end(), feature) == known.end())
      features_[count_++] = feature;
  }

  std::array<Feature, 16> features_;
  std::size_t count_ = 0;
};

// The closed features' distance, of two faces too: those are closest at an edge of one of them.
FeatureDistance anyFeatureDistance(const PolyhedronPair& pair, Feature a, Feature b) {
  if (a.kind != FeatureKind::kFace || b.kind != FeatureKind::kFace) return featureDistance(pair, {a, b});
  FeatureDistance best = featureDistance(pair, {edgeFeature(pair.a.faceEdges(a.index)[0]), b});
  const auto consider = [&](FeaturePair features) {
    const FeatureDistance there = featureDistance(pair, features);
    if (there.crossing || (!best.crossing && there.distance_m < best.distance_m)) best = there;
  };
  for (int e : pair.a.faceEdges(a.index)) consider({edgeFeature(e), b});
  for (int e : pair.b.faceEdges(b.index)) consider({a, edgeFeature(e)});
  return best;
}

// A vertex of the feature (of a face: any).
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

// The unit normal from A to B of features that are apart. A face's normal and the common perpendicular of two
// edges are exact; the direction between the witnesses is as good as the distance is long.
Vec3 normalBetween(const PolyhedronPair& pair, const FeatureDistance& d) {
  const auto [a, b] = d.features;
  if (a.kind == FeatureKind::kFace) return pair.a.plane(a.index).normal;
  if (b.kind == FeatureKind::kFace) return -(pair.R_AB * pair.b.plane(b.index).normal);
  const Vec3 between = (d.p_b - d.p_a).normalized();
  if (a.kind == FeatureKind::kEdge && b.kind == FeatureKind::kEdge) {
    const Vec3 across = pair.a.edge(a.index).direction.cross(pair.R_AB * pair.b.edge(b.index).direction);
    const double sine = across.norm();
    if (sine > kCrossingSine) return (across.dot(between) > 0.0 ? 1.0 / sine : -1.0 / sine) * across;
  }
  return between;
}

enum class Move { kTaken, kStuck, kInside };

class Walk {
 public:
  Walk(const PolyhedronPair& pair, FeaturePair seed, double scale_m)
      : pair_(pair), scale_m_(scale_m), here_(anyFeatureDistance(pair, seed.a, seed.b)) {}

  Move next() {
    if (here_.crossing || here_.distance_m == 0.0) {
      common_is_on_a_ = false;
      return Move::kInside;
    }
    if (here_.behind) return here_.features.a.kind == FeatureKind::kFace ? enterA() : enterB();
    const Vec3 n = normalBetween(pair_, here_);
    const Vec3 minus_n_B = -(pair_.R_AB.transpose() * n);
    const auto up_a = neighbourAcrossVRegion(pair_.a, here_.features.a, n);
    if (up_a && moveTo({*up_a, here_.features.b})) return Move::kTaken;
    const auto up_b = neighbourAcrossVRegion(pair_.b, here_.features.b, minus_n_B);
    if (up_b && moveTo({here_.features.a, *up_b})) return Move::kTaken;
    if (pointsInward(pair_.a, here_.features.a, n)) return enterA();
    if (pointsInward(pair_.b, here_.features.b, minus_n_B)) return enterB();
    const bool doubtful = up_a || up_b || here_.distance_m < kShortDistance * scale_m_;
    return doubtful && slack(n, minus_n_B) > kSlack * scale_m_ && moveAlongBoth(n, minus_n_B) ? Move::kTaken
                                                                                              : Move::kStuck;
  }

  const FeatureDistance& here() const { return here_; }
  /// After kInside: the witness that lies in both bodies.
  const Vec3& commonPoint() const { return common_is_on_a_ ? here_.p_a : here_.p_b; }

 private:
  bool moveTo(FeaturePair features) {
    const FeatureDistance there = anyFeatureDistance(pair_, features.a, features.b);
    if (!there.crossing && !(there.distance_m < here_.distance_m)) return false;
    here_ = there;
    return true;
  }

  // The way between the witnesses ends inside a body: the other witness is inside too, or the entry face is
  // closer.
  Move enterA() { return moveToEntry(entryFace(pair_.a, here_.p_b, here_.p_a), true); }
  Move enterB() { return moveToEntry(entryFace(pair_.b, pair_.toB(here_.p_a), pair_.toB(here_.p_b)), false); }

  Move moveToEntry(std::optional<int> entry, bool entered_a) {
    common_is_on_a_ = !entered_a;
    if (!entry) return Move::kInside;
    const Feature face = faceFeature(*entry);
    const bool moved =
        moveTo(entered_a ? FeaturePair{face, here_.features.b} : FeaturePair{here_.features.a, face});
    // Only rounding can deny the closer face: the witness then is in the surface, and the axes decide.
    return moved ? Move::kTaken : Move::kInside;
  }

  // How much farther apart the witnesses are than the slab across n that is free of both bodies: the most by
  // which the distance can be wrong.
  double slack(const Vec3& n, const Vec3& minus_n_B) const {
    const Vec3& far_a = pair_.a.vertex(pair_.a.support(n, vertexOf(pair_.a, here_.features.a)));
    const Vec3 far_b =
        pair_.toA(pair_.b.vertex(pair_.b.support(minus_n_B, vertexOf(pair_.b, here_.features.b))));
    return here_.distance_m - n.dot(far_b - far_a);
  }

  // Between almost parallel features a step on one body alone gains less than rounding (half the slope
  // squared), a step on both together gains the slope itself.
  bool moveAlongBoth(const Vec3& n, const Vec3& minus_n_B) {
    const double level_sine = kLevelSine * std::sqrt(std::max(1.0, scale_m_ / here_.distance_m));
    const LevelNeighbours on_a(pair_.a, here_.features.a, n, level_sine);
    const LevelNeighbours on_b(pair_.b, here_.features.b, minus_n_B, level_sine);
    bool moved = false;
    for (const Feature a : on_a.all())
      for (const Feature b : on_b.all()) moved = moveTo({a, b}) || moved;
    return moved;
  }

  const PolyhedronPair& pair_;
  double scale_m_;
  FeatureDistance here_;
  bool common_is_on_a_ = false;
};

// Every vertex against every face and every edge against every edge.
FeatureDistance exhaustiveSearch(const PolyhedronPair& pair) {
  FeatureDistance best = featureDistance(pair, {vertexFeature(0), vertexFeature(0)});
  const auto consider = [&](FeaturePair features) {
    const FeatureDistance d = featureDistance(pair, features);
    if (d.crossing || (!d.behind && !best.crossing && d.distance_m < best.distance_m)) best = d;
  };
  for (int i = 0; i < pair.a.vertexCount(); ++i)
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({vertexFeature(i), vertexFeature(j)});
  for (int i = 0; i < pair.a.edgeCount(); ++i) {
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({edgeFeature(i), vertexFeature(j)});
    for (int j = 0; j < pair.b.edgeCount(); ++j) consider({edgeFeature(i), edgeFeature(j)});
    for (int j = 0; j < pair.b.faceCount(); ++j) consider({edgeFeature(i), faceFeature(j)});
  }
  for (int j = 0; j < pair.b.edgeCount(); ++j) {
    for (int i = 0; i < pair.a.vertexCount(); ++i) consider({vertexFeature(i), edgeFeature(j)});
    for (int i = 0; i < pair.a.faceCount(); ++i) consider({faceFeature(i), edgeFeature(j)});
  }
  for (int i = 0; i < pair.a.faceCount(); ++i)
    for (int j = 0; j < pair.b.vertexCount(); ++j) consider({faceFeature(i), vertexFeature(j)});
  for (int j = 0; j < pair.b.faceCount(); ++j)
    for (int i = 0; i < pair.a.vertexCount(); ++i) consider({vertexFeature(i), faceFeature(j)});
  return best;
}

struct CoreAnswer {
  double gap_m;
  Vec3 normal, p_a, p_b;
  FeaturePair features;
};

// The axes give the normal, and the depth of cores that intersect. Cores that merely touch keep the witnesses
// that the walk found: the foot of a support vertex may lie beside its face when several vertices are equally
// far.
CoreAnswer fromAxes(const PolyhedronPair& pair, const FeatureDistance& found, const Vec3* common,
                    double touching_m) {
  const MinimumTranslation m = minimumTranslation(pair);
  if (m.gap_m < -touching_m) return {m.gap_m, m.normal, m.p_a, m.p_b, m.features};
  if (!common) return {found.distance_m, m.normal, found.p_a, found.p_b, found.features};
  return {m.gap_m, m.normal, *common, *common + m.gap_m * m.normal, m.features};
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked) {
  const PolyhedronPair pair(a.core, X_WA, b.core, X_WB);
  if (tracked.a.index < 0 || tracked.b.index < 0) tracked = coldSeed(pair);
  // Walks are short; the bound is the number of features, which a strictly falling sequence of neighbours
  // never needs.
  const int bound = 100 + 2 * (a.core.edgeCount() + b.core.edgeCount());

  const double scale = pair.t_AB.norm() + a.core.width() + b.core.width();

  ClosestFeatures result;
  Walk walk(pair, tracked, scale);
  Move move = Move::kTaken;
  for (result.states = 1; result.states < bound && (move = walk.next()) == Move::kTaken;) ++result.states;
  result.reached_limit = move == Move::kTaken;
  FeatureDistance found = walk.here();
  Vec3 common = walk.commonPoint();
  bool inside = move == Move::kInside;
  if (result.reached_limit) {
    found = exhaustiveSearch(pair);
    inside = found.crossing;
    common = found.p_b;
  }

  const bool directed = !inside && found.distance_m > kNoDirection * scale;
  const CoreAnswer core = directed ? CoreAnswer{found.distance_m, normalBetween(pair, found), found.p_a,
                                                found.p_b, found.features}
                                   : fromAxes(pair, found, inside ? &common : nullptr, kNoDirection * scale);
  tracked = core.features;
  result.features = core.features;
  const Mat3 R_WA = X_WA.rotation.toRotationMatrix();
  result.n_W = R_WA * core.normal;
  result.distance_m = core.gap_m - a.radius_m - b.radius_m;
  result.p_A_W = R_WA * (core.p_a + a.radius_m * core.normal) + X_WA.position;
  result.p_B_W = R_WA * (core.p_b - b.radius_m * core.normal) + X_WA.position;
  if (result.distance_m > kTouching * scale)
    result.status = Separation::kSeparated;
  else
    result.status =
        result.distance_m >= -kTouching * scale ? Separation::kTouching : Separation::kPenetrating;
  return result;
}

}  // namespace carom
