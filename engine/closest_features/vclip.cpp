#include "engine/closest_features/vclip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/closest_features/canonical_features.h"
#include "engine/closest_features/certificate.h"
#include "engine/closest_features/penetrating/penetration.h"
#include "engine/closest_features/penetrating/warm_facet.h"
#include "engine/closest_features/separated/exhaustive_search.h"
#include "engine/closest_features/separated/feature_walk.h"
#include "engine/closest_features/separated/level_axes.h"
#include "engine/closest_features/separated/warm_pair.h"
#include "engine/foundation/contract.h"

namespace carom {
namespace {

// Cores closer than this, relative to their size, have no trustworthy direction between their witnesses; the
// separating axes give it.
constexpr double kNoDirection = 1e-9;
// Rounding within a query, relative to its lengths, and of the positions, relative to their coordinates.
constexpr double kNoise = 0x1p-47;
constexpr double kShift = 0x1p-51;
// The square of a length shorter than this loses digits or is zero: it has no direction, metres.
constexpr double kShortest = 0x1p-500;
// A walk of this many states began far off: features that face each other are tried as a new start.
constexpr int kStaleStates = 6;
constexpr int kLongWalk = 12;
// An answer that support planes leave more room than this, relative to the size, is not proven.
constexpr double kRoom = 0x1p-41;
// Distances below this relative to the size are touching.
constexpr double kTouching = 1e-14;

// What lengths are compared with, metres.
struct Scale {
  Scale(const ConvexPolyhedron& a, const Pose& X_WA, const ConvexPolyhedron& b, const Pose& X_WB)
      : size_m((X_WB.position - X_WA.position).lpNorm<1>() + a.reach() + b.reach()),
        noise_m(std::max(kNoise * size_m, kShortest)),
        shift_m(noise_m + kShift * (X_WA.position.lpNorm<1>() + X_WB.position.lpNorm<1>())) {}

  double size_m;
  double noise_m;  // how far rounding within the query may move a point
  double shift_m;  // how far one body may be moved against the other by the rounding of their positions
};

struct Visits {
  int states = 1;              // feature pairs
  bool reached_limit = false;  // an exhaustive search followed
};

CoreAnswer answerFrom(const MinimumTranslation& m) {
  return {m.gap_m, m.normal, m.p_a, m.p_b, m.features};
}

MinimumTranslation minimumTranslation(const PolyhedronPair& pair, double noise_m, InnerPolytope& polytope) {
  const bool solid = pair.a.faceCount() > 0 || pair.b.faceCount() > 0;
  return solid ? polytope.minimumTranslation(pair, noise_m) : largestGap(pair);
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
    if (!lowest || comesBefore(pair, candidate.features, lowest->features)) lowest = candidate;
  }
  if (lowest) {
    answer = *lowest;
  } else if (polytope.triangleCount() > 0) {
    polytope.placeWitnesses(pair, facets[0]);
    answer = answerFrom(facets[0]);
  }
}

// The end of a walk that left doubt: the features are not unique, or too close for the witnesses to have a
// direction. `axes`: the minimum translation, if it has been asked for; the bodies do not intersect.
void settle(const PolyhedronPair& pair, const FeatureWalk& walk, bool inside,
            const std::optional<MinimumTranslation>& axes, const Scale& scale, InnerPolytope& polytope,
            CoreAnswer& answer) {
  const FeatureDistance& found = walk.here();
  const bool directed = !inside && (found.distance() > kNoDirection * scale.size_m ||
                                    (found.distance() > scale.noise_m && acrossOf(pair, found).exact));
  if (directed) {
    answer = answerFrom(pair, found);
    makeCanonical(pair, answer, scale.noise_m, scale.shift_m);
    return;
  }
  const MinimumTranslation m = axes ? *axes : minimumTranslation(pair, scale.noise_m, polytope);
  answer = answerFrom(m);
  if (m.gap_m < -scale.noise_m) return makeDepthCanonical(pair, scale, polytope, false, answer);
  if (inside) {  // they touch, to rounding
    answer.p_a = walk.commonPoint();
    answer.p_b = walk.commonPoint() + m.gap_m * m.normal;
    makeCanonical(pair, answer, scale.noise_m, scale.shift_m);
    return;
  }
  // A facet whose features hold its witnesses is the answer; else what the walk found is, and the wider slab
  // has the better normal.
  if (makeCanonical(pair, answer, scale.noise_m, scale.shift_m)) return;
  answer = answerFrom(pair, found);
  // Of witnesses in one point, or along their own edge by rounding, there is no normal.
  const bool has_normal = answer.gap_m > 0.0 && answer.normal.allFinite();
  if (!has_normal || m.gap_m > slabAlong(pair, answer.features, answer.normal)) answer.normal = m.normal;
  makeCanonical(pair, answer, scale.noise_m, scale.shift_m);
}

// The depth of a pair that intersected last time, if what is remembered proves that it still does: a facet,
// or the polytope. Else it is all forgotten, but for the features that the bodies have parted at.
bool followDepth(const PolyhedronPair& pair, const Scale& scale, PairMemory& memory, CoreAnswer& answer) {
  InnerPolytope& polytope = memory.penetration;
  if (!polytope.isOf(pair)) {
    polytope.forget();
    memory.features = {};
    return false;
  }
  const std::optional<WarmFacet> warm = nearestFacet(pair, memory.features, scale.noise_m);
  if (warm && warm->proven) {
    answer = answerFrom(warm->gap);
    if (warm->inside_m > scale.shift_m && clearlyAlone(pair, answer, scale.shift_m)) return true;
  }
  const bool parted = warm && warm->gap.gap_m > scale.noise_m;
  std::optional<MinimumTranslation> found;
  if (warm && warm->proven)
    found = polytope.minimumTranslation(pair, scale.noise_m, &warm->gap);
  else if (!parted && !(warm && warm->stale))
    found = polytope.follow(pair, scale.noise_m, warm ? &warm->gap : nullptr);
  if (found && found->gap_m < -scale.noise_m) {
    answer = answerFrom(*found);
    if (!clearlyInside(pair, answer, scale.shift_m) || !clearlyAlone(pair, answer, scale.shift_m))
      makeDepthCanonical(pair, scale, polytope, true, answer);
    return true;
  }
  polytope.forget();
  memory.features = parted ? warm->gap.features : FeaturePair{};
  return false;
}

// From the features of the last query to those of this one, which are not clearly the same. One variable is
// returned everywhere: it is then built in its place, and what has just been written is not copied.
CoreAnswer closestCores(const PolyhedronPair& pair, const Scale& scale, FeaturePair tracked,
                        InnerPolytope& polytope, Visits& visits) {
  CoreAnswer answer;
  // Walks are short; the bound is the number of features, which a strictly falling sequence of neighbours
  // never needs.
  const int bound = 100 + 2 * (pair.a.edgeCount() + pair.b.edgeCount());
  FeatureWalk walk(pair, tracked, scale.size_m, scale.shift_m);
  std::optional<MinimumTranslation> axes;
  bool restarted = false;
  Move move = Move::kTaken;
  for (; visits.states < bound; ++visits.states) {
    move = walk.next();
    if (move == Move::kClear) {
      answer = walk.answer();
      return answer;
    }
    if (move == Move::kLevel) break;
    if (move == Move::kTaken) {
      if (visits.states % kStaleStates == 0) walk.jump();
      if (visits.states != kLongWalk) continue;
    }
    // A walk with no way on, or a long one (around large faces of bodies that intersect it can be): the axes
    // tell whether the bodies intersect, and lead on if not.
    axes = minimumTranslation(pair, scale.noise_m, polytope);
    if (axes->gap_m < -scale.noise_m) {
      answer = answerFrom(*axes);
      makeDepthCanonical(pair, scale, polytope, false, answer);
      return answer;
    }
    if (move == Move::kInside && (axes->gap_m <= scale.noise_m || walk.here().distance() <= scale.shift_m))
      break;
    if (walk.jumpTo(axes->features) || move == Move::kTaken) {
      move = Move::kTaken;
      continue;
    }
    if (restarted) break;
    restarted = true;
    walk.restart(axes->features);
  }
  settle(pair, walk, move == Move::kInside, axes, scale, polytope, answer);
  // The support planes leave no room for a shorter way, or a longer search has to find it.
  visits.reached_limit =
      std::abs(answer.gap_m - slabAlong(pair, answer.features, answer.normal)) > kRoom * scale.size_m;
  if (!visits.reached_limit) return answer;
  walk.startFrom(exhaustiveSearch(pair));
  settle(pair, walk, walk.here().crossing, std::nullopt, scale, polytope, answer);
  return answer;
}

// Whether what was closest last time, or what it leads on to, clearly is; places are seen from A's origin.
PairsInPlace findInPlace(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                         double noise_m, PairMemory& memory, PlacedGap& gap) {
  const PlacedPolyhedron placed_a(a.core, X_WA.rotation, Vec3::Zero());
  const PlacedPolyhedron placed_b(b.core, X_WB.rotation, X_WB.position - X_WA.position);
  return findClearlyClosest(placed_a, placed_b, noise_m, memory.features, gap);
}

// The answer of a query whose cores have this gap, seen from A's origin.
ClosestFeatures answerOf(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const PlacedGap& gap,
                         const Scale& scale, FeaturePair features, const Visits& visits) {
  const double distance_m = gap.length_m - a.radius_m - b.radius_m;
  const double touching = kTouching * scale.size_m;
  const Vec3 p_A_W = gap.p_a + a.radius_m * gap.normal + X_WA.position;
  return {.status = distance_m > touching     ? Separation::kSeparated
                    : distance_m >= -touching ? Separation::kTouching
                                              : Separation::kPenetrating,
          .distance_m = distance_m,
          .p_A_W = p_A_W,
          .p_B_W = p_A_W + distance_m * gap.normal,
          .n_W = gap.normal,
          .features = features,
          .states = visits.states,
          .reached_limit = visits.reached_limit};
}

// An answer seen from A's origin, its features left for the next query.
PlacedGap keepFeatures(const CoreAnswer& core, const Pose& X_WA, PairMemory& memory) {
  memory.features = core.features;
  const Rotation R_WA(X_WA.rotation);
  return {core.gap_m, R_WA * core.normal, R_WA * core.p_a};
}

ClosestFeatures query(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                      PairMemory& memory) {
  const Scale scale(a.core, X_WA, b.core, X_WB);
  PlacedGap gap;
  Visits visits;
  if (memory.penetration.triangleCount() > 0) {
    const PolyhedronPair pair(a.core, X_WA, b.core, X_WB);
    CoreAnswer core;
    if (followDepth(pair, scale, memory, core))
      return answerOf(a, X_WA, b, keepFeatures(core, X_WA, memory), scale, core.features, visits);
  }
  const PairsInPlace in_place = findInPlace(a, X_WA, b, X_WB, scale.shift_m, memory, gap);
  if (in_place.found) return answerOf(a, X_WA, b, gap, scale, memory.features, {in_place.visited, false});
  const PolyhedronPair pair(a.core, X_WA, b.core, X_WB);
  const CoreAnswer core = closestCores(pair, scale, memory.features, memory.penetration, visits);
  visits.states += in_place.visited;
  return answerOf(a, X_WA, b, keepFeatures(core, X_WA, memory), scale, core.features, visits);
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                PairMemory& memory) {
  const ClosestFeatures result = query(a, X_WA, b, X_WB, memory);
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
