#include "engine/closest_features/vclip.h"

#include <algorithm>
#include <limits>
#include <optional>

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

// Vertices that face each other: far along the line between the bodies' first vertices.
FeaturePair coldSeed(const PolyhedronPair& pair) {
  const Vec3 toward_b = pair.toA(pair.b.vertex(0)) - pair.a.vertex(0);
  const int va = pair.a.support(toward_b);
  const int vb = pair.b.support(-(pair.R_AB.transpose() * toward_b));
  return {vertexFeature(va), vertexFeature(vb)};
}

// A vertex v outside A (frame of A) whose closest point on one face lies behind it: the face through which the line
// from v to that point enters A, or none when v is inside.
std::optional<int> entryFace(const ConvexPolyhedron& a, const Vec3& v, const Vec3& inside) {
  std::optional<int> entry;
  double latest = -1.0;
  for (int f = 0; f < a.faceCount(); ++f) {
    const double h_v = a.plane(f).signedDistance(v);
    if (h_v <= 0.0) continue;
    const double h_inside = std::min(a.plane(f).signedDistance(inside), 0.0);
    const double t = h_v / (h_v - h_inside);
    if (t > latest) {
      latest = t;
      entry = f;
    }
  }
  return entry;
}

enum class Move { kTaken, kStuck, kInside };

class Walk {
 public:
  Walk(const PolyhedronPair& pair, FeaturePair seed) : pair_(pair), here_(featureDistance(pair, seed)) {}

  Move next() {
    if (here_.crossing || here_.distance_m == 0.0) return Move::kInside;
    if (here_.behind) return leaveBackOfFace();
    const Vec3 n = here_.p_b - here_.p_a;
    if (const auto up = neighbourAcrossVRegion(pair_.a, here_.features.a, n))
      if (moveTo({*up, here_.features.b})) return Move::kTaken;
    if (const auto up = neighbourAcrossVRegion(pair_.b, here_.features.b, -(pair_.R_AB.transpose() * n)))
      if (moveTo({here_.features.a, *up})) return Move::kTaken;
    return Move::kStuck;
  }

  const FeatureDistance& here() const { return here_; }

 private:
  bool moveTo(FeaturePair features) {
    const FeatureDistance there = featureDistance(pair_, features);
    if (!there.crossing && !(there.distance_m < here_.distance_m)) return false;
    here_ = there;
    return true;
  }

  Move leaveBackOfFace() {
    const bool face_on_a = here_.features.a.kind == FeatureKind::kFace;
    const std::optional<int> entry = face_on_a ? entryFace(pair_.a, here_.p_b, here_.p_a)
                                               : entryFace(pair_.b, pair_.toB(here_.p_a), pair_.toB(here_.p_b));
    if (!entry) return Move::kInside;
    const FeaturePair closer = face_on_a ? FeaturePair{faceFeature(*entry), here_.features.b}
                                         : FeaturePair{here_.features.a, faceFeature(*entry)};
    // Only rounding can deny the closer face: the vertex then is in the surface, and the axes decide.
    return moveTo(closer) ? Move::kTaken : Move::kInside;
  }

  const PolyhedronPair& pair_;
  FeatureDistance here_;
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

CoreAnswer fromAxes(const PolyhedronPair& pair) {
  const MinimumTranslation m = minimumTranslation(pair);
  return {m.gap_m, m.normal, m.p_a, m.p_b, m.features};
}

// A face's own normal is exact; else the direction between the witnesses.
CoreAnswer fromWitnesses(const PolyhedronPair& pair, const FeatureDistance& d) {
  Vec3 normal = (d.p_b - d.p_a) / d.distance_m;
  if (d.features.a.kind == FeatureKind::kFace) normal = pair.a.plane(d.features.a.index).normal;
  if (d.features.b.kind == FeatureKind::kFace) normal = -(pair.R_AB * pair.b.plane(d.features.b.index).normal);
  return {d.distance_m, normal, d.p_a, d.p_b, d.features};
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked) {
  const PolyhedronPair pair(a.core, X_WA, b.core, X_WB);
  if (tracked.a.index < 0 || tracked.b.index < 0) tracked = coldSeed(pair);
  // Walks are short; the bound is the number of features, which a strictly falling sequence of neighbours never needs.
  const int bound = 100 + 2 * (a.core.edgeCount() + b.core.edgeCount());

  ClosestFeatures result;
  Walk walk(pair, tracked);
  Move move = Move::kTaken;
  for (result.states = 1; result.states < bound && (move = walk.next()) == Move::kTaken;) ++result.states;
  result.reached_limit = move == Move::kTaken;
  FeatureDistance found = walk.here();
  bool inside = move == Move::kInside;
  if (result.reached_limit) {
    found = exhaustiveSearch(pair);
    inside = found.crossing;
  }

  const double scale = pair.t_AB.norm() + a.core.width() + b.core.width();
  const bool directed = !inside && found.distance_m > kNoDirection * scale;
  const CoreAnswer core = directed ? fromWitnesses(pair, found) : fromAxes(pair);
  tracked = core.features;
  result.features = core.features;
  const Mat3 R_WA = X_WA.rotation.toRotationMatrix();
  result.n_W = R_WA * core.normal;
  result.distance_m = core.gap_m - a.radius_m - b.radius_m;
  result.p_A_W = R_WA * (core.p_a + a.radius_m * core.normal) + X_WA.position;
  result.p_B_W = R_WA * (core.p_b - b.radius_m * core.normal) + X_WA.position;
  if (result.distance_m > kTouching * scale) result.status = Separation::kSeparated;
  else result.status = result.distance_m >= -kTouching * scale ? Separation::kTouching : Separation::kPenetrating;
  return result;
}

}  // namespace carom
