#include "engine/closest_features/vclip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/closest_features/canonical_features.h"
#include "engine/closest_features/certificate.h"
#include "engine/closest_features/feature_distance.h"
#include "engine/closest_features/level_axes.h"
#include "engine/closest_features/penetration.h"
#include "engine/closest_features/v_region.h"
#include "engine/closest_features/warm_pair.h"
#include "engine/foundation/contract.h"

namespace carom {
namespace {

// Cores closer than this, relative to their size, have no trustworthy direction between their witnesses; the
// separating axes give it.
constexpr double kNoDirection = 1e-9;
// A slope below this is rounding of a unit product: walking along it could not shorten the distance
// measurably.
constexpr double kFlatSlope = 1e-15;
// Rounding within a query, relative to its lengths, and of the positions, relative to their coordinates.
constexpr double kNoise = 0x1p-47;
constexpr double kShift = 0x1p-51;
// Squared distances this close are equal, to rounding.
constexpr double kAsClose = 1.0 + 0x1p-50;
// A walk of this many states began far off: features that face each other are tried as a new start.
constexpr int kStaleStates = 6;
constexpr int kLongWalk = 12;
// Distances below this relative to the size are touching.
constexpr double kTouching = 1e-14;
// A distance that may be wrong by more than this, relative to the size, is looked at again.
constexpr double kSlack = 0x1p-50;
// A slope s gains d s^2 / 2 at distance d, which rounding hides up to s^2 = 1e-16 * size / d or so. Features
// this close to level at a distance of the size, and closer in proportion, are looked at together.
constexpr double kLevelSine = 1e-6;
// Edges that cross at a larger angle have a well-defined common perpendicular.
constexpr double kCrossingSine = 1e-3;

// The vertices that face each other along a direction from A to B.
FeaturePair facingVertices(const PolyhedronPair& pair, const Vec3& toward_b) {
  const int va = pair.a.support(toward_b);
  const int vb = pair.b.support(-pair.directionToB(toward_b));
  return {vertexFeature(va), vertexFeature(vb)};
}

FeaturePair coldSeed(const PolyhedronPair& pair) {
  return facingVertices(pair, pair.toA(pair.b.center()) - pair.a.center());
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
    if (there.crossing || (!best.crossing && there.squared_m2 < best.squared_m2)) best = there;
  };
  for (int e : pair.a.faceEdges(a.index)) consider({edgeFeature(e), b});
  for (int e : pair.b.faceEdges(b.index)) consider({a, edgeFeature(e)});
  return best;
}

// The way from A to B across a pair of features, of any length. A face's normal and the common perpendicular
// of two edges are exact; the difference of the witnesses is as good as it is long.
struct Across {
  Vec3 w;
  double length;
  bool exact;
  Vec3 unit() const { return w / length; }
};

Across acrossOf(const PolyhedronPair& pair, const FeatureDistance& d) {
  const auto [a, b] = d.features;
  if (a.kind == FeatureKind::kFace) return {pair.a.plane(a.index).normal, 1.0, true};
  if (b.kind == FeatureKind::kFace) return {-pair.directionToA(pair.b.plane(b.index).normal), 1.0, true};
  const Vec3 between = d.p_b - d.p_a;
  if (a.kind == FeatureKind::kEdge && b.kind == FeatureKind::kEdge) {
    const Vec3 common =
        pair.a.edge(a.index).direction.cross(pair.directionToA(pair.b.edge(b.index).direction));
    const double sine = common.norm();
    if (sine > kCrossingSine) return {common.dot(between) > 0.0 ? common : -common, sine, true};
  }
  return {between, d.distance(), false};
}

void answerFrom(const PolyhedronPair& pair, const FeatureDistance& found, CoreAnswer& answer) {
  answer.gap_m = found.distance();
  answer.normal = acrossOf(pair, found).unit();
  answer.p_a = found.p_a;
  answer.p_b = found.p_b;
  answer.features = found.features;
}

int dimensions(const FeaturePair& features) {
  return static_cast<int>(features.a.kind) + static_cast<int>(features.b.kind);
}

enum class Move { kTaken, kClear, kStuck, kInside };

class Walk {
 public:
  Walk(const PolyhedronPair& pair, FeaturePair seed, double scale_m, double noise_m)
      : pair_(pair),
        scale_m_(scale_m),
        noise_m_(noise_m),
        noise_slope_(noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge())),
        seen_{anyFeatureDistance(pair, seed.a, seed.b), FeatureDistance{}},
        lowest_m2_(seen_[0].squared_m2) {}

  Move next() {
    const FeatureDistance& at = here();
    if (at.crossing || at.squared_m2 == 0.0) {
      common_is_on_a_ = false;
      return Move::kInside;
    }
    if (at.behind) return at.features.a.kind == FeatureKind::kFace ? enterA() : enterB();
    const Across n = acrossOf(pair_, at);
    const Vec3 minus_n_B = -pair_.directionToB(n.w);
    const double flat = kFlatSlope * n.length;
    const WayOff off_a = steepestWayOff(pair_.a, at.features.a, n.w);
    if (off_a.slope > flat && moveTo({off_a.neighbour, at.features.b})) return Move::kTaken;
    const WayOff off_b = steepestWayOff(pair_.b, at.features.b, minus_n_B);
    if (off_b.slope > flat && moveTo({at.features.a, off_b.neighbour})) return Move::kTaken;
    // Every way off leads down by more than rounding can hide: both bodies lie beyond their support planes.
    const double steepest = std::max(off_a.slope, off_b.slope);
    const double margin = noise_slope_ * n.length + (n.exact ? 0.0 : noise_m_);
    if (steepest < -margin && at.inside_m > noise_m_ && at.squared_m2 > noise_m_ * noise_m_)
      return Move::kClear;
    if (pointsInward(pair_.a, at.features.a, n.w)) return enterA();
    if (pointsInward(pair_.b, at.features.b, minus_n_B)) return enterB();
    if (at.distance() <= noise_m_) {  // touching or deep inside: the axes tell
      common_is_on_a_ = false;
      return Move::kInside;
    }
    const Vec3 unit = n.unit();
    if (at.distance() - slabAlong(pair_, at.features, unit) <= kSlack * scale_m_) return Move::kStuck;
    return moveToLevelAxis() || moveAlongBoth(unit, minus_n_B / n.length) ? Move::kTaken : Move::kStuck;
  }

  /// Goes on from another pair if that is closer: from a given one, or from what faces each other along the
  /// line of centres, or along the way between the witnesses.
  void jumpTo(FeaturePair seed) { moveTo(seed); }
  void jump() { moveTo(coldSeed(pair_)) || moveTo(facingVertices(pair_, here().p_b - here().p_a)); }

  const FeatureDistance& here() const { return seen_[here_]; }
  /// After kInside: the witness that lies in both bodies.
  const Vec3& commonPoint() const { return common_is_on_a_ ? here().p_a : here().p_b; }

 private:
  bool moveTo(FeaturePair features) {
    // Built in its place: to copy what has just been written costs more than to compute it.
    const FeatureDistance& there =
        *::new (&seen_[1 - here_]) FeatureDistance(anyFeatureDistance(pair_, features.a, features.b));
    const bool closer = there.crossing || there.squared_m2 < lowest_m2_;
    const bool as_close = there.squared_m2 <= lowest_m2_ * kAsClose;
    if (!closer && !(as_close && dimensions(there.features) > dimensions(here().features))) return false;
    lowest_m2_ = std::min(lowest_m2_, there.squared_m2);
    here_ = 1 - here_;
    return true;
  }

  // The way between the witnesses ends inside a body: the other witness is inside too, or the entry face is
  // closer.
  Move enterA() { return moveToEntry(entryFace(pair_.a, here().p_b, here().p_a), true); }
  Move enterB() {
    return moveToEntry(entryFace(pair_.b, pair_.toB(here().p_a), pair_.toB(here().p_b)), false);
  }

  Move moveToEntry(std::optional<int> entry, bool entered_a) {
    common_is_on_a_ = !entered_a;
    if (!entry) return Move::kInside;
    const Feature face = faceFeature(*entry);
    const bool moved =
        moveTo(entered_a ? FeaturePair{face, here().features.b} : FeaturePair{here().features.a, face});
    // Only rounding can deny the closer face: the witness then is in the surface, and the axes decide.
    return moved ? Move::kTaken : Move::kInside;
  }

  // The features of a slab wider than the present one are closer than the present ones, if they hold it.
  bool moveToLevelAxis() {
    thread_local std::vector<MinimumTranslation> axes;
    CoreAnswer present;
    answerFrom(pair_, here(), present);
    gatherLevelAxes(pair_, present, noise_m_, axes);
    bool moved = false;
    for (const MinimumTranslation& axis : axes) moved = moveTo(axis.features) || moved;
    return moved;
  }

  // Between almost parallel features a step on one body alone gains less than rounding (half the slope
  // squared), a step on both together gains the slope itself.
  bool moveAlongBoth(const Vec3& n, const Vec3& minus_n_B) {
    const double level_sine = kLevelSine * std::sqrt(std::max(1.0, scale_m_ / here().distance()));
    const LevelNeighbours on_a(pair_.a, here().features.a, n, level_sine);
    const LevelNeighbours on_b(pair_.b, here().features.b, minus_n_B, level_sine);
    bool moved = false;
    for (const Feature a : on_a.all())
      for (const Feature b : on_b.all())
        if (a.kind != FeatureKind::kFace || b.kind != FeatureKind::kFace) moved = moveTo({a, b}) || moved;
    return moved;
  }

  const PolyhedronPair& pair_;
  double scale_m_, noise_m_, noise_slope_;
  std::array<FeatureDistance, 2> seen_;
  std::size_t here_ = 0;
  double lowest_m2_;
  bool common_is_on_a_ = false;
};

// Every vertex against every face and every edge against every edge.
FeatureDistance exhaustiveSearch(const PolyhedronPair& pair) {
  FeatureDistance best = featureDistance(pair, {vertexFeature(0), vertexFeature(0)});
  const auto consider = [&](FeaturePair features) {
    const FeatureDistance d = featureDistance(pair, features);
    if (d.crossing || (!d.behind && !best.crossing && d.squared_m2 < best.squared_m2)) best = d;
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

// What lengths are compared with, metres.
struct Scale {
  Scale(const PolyhedronPair& pair, const Pose& X_WA, const Pose& X_WB)
      : size_m(pair.t_AB.lpNorm<1>() + pair.a.reach() + pair.b.reach()),
        noise_m(kNoise * size_m),
        shift_m(noise_m + kShift * (X_WA.position.lpNorm<1>() + X_WB.position.lpNorm<1>())) {}

  double size_m;
  double noise_m;  // how far rounding within the query may move a point
  double shift_m;  // how far one body may be moved against the other by the rounding of their positions
};

CoreAnswer answerFrom(const MinimumTranslation& m) {
  return {m.gap_m, m.normal, m.p_a, m.p_b, m.features};
}

MinimumTranslation minimumTranslation(const PolyhedronPair& pair, double noise_m, InnerPolytope& polytope) {
  const bool solid = pair.a.faceCount() > 0 || pair.b.faceCount() > 0;
  return solid ? polytope.minimumTranslation(pair, noise_m) : largestGap(pair);
}

// The end of a walk that left doubt: the features are not unique, or too close for the witnesses to have a
// direction, or the bodies intersect.
void settle(const PolyhedronPair& pair, const Walk& walk, Move move, const Scale& scale,
            InnerPolytope& polytope, CoreAnswer& answer) {
  FeatureDistance found = walk.here();
  Vec3 common = walk.commonPoint();
  bool inside = move == Move::kInside;
  if (move == Move::kTaken) {
    found = exhaustiveSearch(pair);
    inside = found.crossing;
    common = found.p_b;
  }
  const bool directed = !inside && (found.distance() > kNoDirection * scale.size_m ||
                                    (found.squared_m2 > 0.0 && acrossOf(pair, found).exact));
  if (directed) return answerFrom(pair, found, answer);
  const MinimumTranslation m = minimumTranslation(pair, scale.noise_m, polytope);
  answer = answerFrom(m);
  if (m.gap_m < -scale.noise_m) return;
  polytope.forget();
  if (inside) {  // they touch, to rounding
    answer.p_a = common;
    answer.p_b = common + m.gap_m * m.normal;
    return;
  }
  // A facet whose features hold its witnesses is the answer; else what the walk found is, and the wider slab
  // has the better normal.
  if (makeCanonical(pair, answer, scale.noise_m, scale.shift_m)) return;
  answerFrom(pair, found, answer);
  if (!(answer.gap_m > 0.0) || m.gap_m > slabAlong(pair, answer.features, answer.normal))
    answer.normal = m.normal;
}

// Features in an order that swapping the bodies does not change.
std::array<int, 3> swapFreeOrder(const FeaturePair& f) {
  return {static_cast<int>(f.a.kind) + static_cast<int>(f.b.kind), std::min(f.a.index, f.b.index),
          std::max(f.a.index, f.b.index)};
}

// The canonical features of a depth; of facets that are equally near, the lowest. Where rounding leaves no
// features that hold the witnesses, they lie between vertices.
void makeDepthCanonical(const PolyhedronPair& pair, const Scale& scale, InnerPolytope& polytope, bool tracked,
                        CoreAnswer& answer) {
  thread_local std::vector<MinimumTranslation> facets;
  facets.assign(1, {answer.gap_m, answer.normal, answer.features, answer.p_a, answer.p_b});
  if (!tracked && polytope.triangleCount() > 0) polytope.equalFacets(pair, facets);
  std::optional<CoreAnswer> lowest;
  for (const MinimumTranslation& facet : facets) {
    CoreAnswer candidate = answerFrom(facet);
    if (!makeCanonical(pair, candidate, scale.noise_m, scale.shift_m)) continue;
    if (!lowest || swapFreeOrder(candidate.features) < swapFreeOrder(lowest->features)) lowest = candidate;
  }
  if (lowest) {
    answer = *lowest;
  } else if (polytope.triangleCount() > 0) {
    polytope.placeWitnesses(pair, facets[0]);
    answer = answerFrom(facets[0]);
  }
}

// From the features of the last query to those of this one.
CoreAnswer closestCores(const PolyhedronPair& pair, const Scale& scale, FeaturePair tracked,
                        InnerPolytope& polytope, ClosestFeatures& result) {
  CoreAnswer answer;
  result.states = 1;
  if (polytope.triangleCount() > 0) {
    answer = answerFrom(polytope.minimumTranslation(pair, scale.noise_m));
    if (answer.gap_m < -scale.noise_m) {
      if (!clearlyAlone(pair, answer, scale.shift_m)) makeDepthCanonical(pair, scale, polytope, true, answer);
      return answer;
    }
    polytope.forget();
    tracked = answer.features;
  }
  if (tracked.a.index < 0 || tracked.b.index < 0) tracked = coldSeed(pair);
  if (clearlyClosest(pair, tracked, scale.shift_m, answer)) return answer;

  // Walks are short; the bound is the number of features, which a strictly falling sequence of neighbours
  // never needs.
  const int bound = 100 + 2 * (pair.a.edgeCount() + pair.b.edgeCount());
  Walk walk(pair, tracked, scale.size_m, scale.shift_m);
  Move move = Move::kTaken;
  for (; result.states < bound && (move = walk.next()) == Move::kTaken; ++result.states) {
    if (result.states % kStaleStates == 0) walk.jump();
    if (result.states != kLongWalk) continue;
    // Around large faces of bodies that intersect a walk can be long; the axes tell, and lead on if they
    // don't.
    const MinimumTranslation m = minimumTranslation(pair, scale.noise_m, polytope);
    if (m.gap_m < -scale.noise_m) {
      answer = answerFrom(m);
      makeDepthCanonical(pair, scale, polytope, false, answer);
      return answer;
    }
    polytope.forget();
    walk.jumpTo(m.features);
  }
  result.reached_limit = move == Move::kTaken;
  if (move == Move::kClear) {
    answerFrom(pair, walk.here(), answer);
    return answer;
  }
  settle(pair, walk, move, scale, polytope, answer);
  if (answer.gap_m < -scale.noise_m)
    makeDepthCanonical(pair, scale, polytope, false, answer);
  else
    makeCanonical(pair, answer, scale.noise_m, scale.shift_m);
  return answer;
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                PairMemory& memory) {
  const PolyhedronPair pair(a.core, X_WA, b.core, X_WB);
  const Scale scale(pair, X_WA, X_WB);
  ClosestFeatures result;
  const CoreAnswer core = closestCores(pair, scale, memory.features, memory.penetration, result);
  memory.features = core.features;
  result.features = core.features;
  const Rotation R_WA(X_WA.rotation);
  result.n_W = R_WA * core.normal;
  result.distance_m = core.gap_m - a.radius_m - b.radius_m;
  result.p_A_W = R_WA * (core.p_a + a.radius_m * core.normal) + X_WA.position;
  result.p_B_W = result.p_A_W + result.distance_m * result.n_W;
  const double touching = kTouching * scale.size_m;
  result.status = result.distance_m > touching     ? Separation::kSeparated
                  : result.distance_m >= -touching ? Separation::kTouching
                                                   : Separation::kPenetrating;
#ifndef NDEBUG
  const Certificate certificate = certify(result, a, X_WA, b, X_WB, &memory);
  REQUIRE(certificate.error_m <= certifiedError(a, X_WA, b, X_WB), certificate.error_m, result.distance_m);
#endif
  return result;
}

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked) {
  thread_local PairMemory memory;  // only its room is kept
  memory.features = tracked;
  memory.penetration.forget();
  const ClosestFeatures result = closestFeatures(a, X_WA, b, X_WB, memory);
  tracked = memory.features;
  return result;
}

}  // namespace carom
