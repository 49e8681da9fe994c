#include "engine/closest_features/vclip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/closest_features/canonical_features.h"
#include "engine/closest_features/certificate.h"
#include "engine/closest_features/penetrating/penetration.h"
#include "engine/closest_features/penetrating/warm_facet.h"
#include "engine/closest_features/separated/exhaustive_search.h"
#include "engine/closest_features/separated/feature_walk.h"
#include "engine/closest_features/separated/level_axes.h"
#include "engine/closest_features/separated/warm_pair.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/stack_arena.h"

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
// Distances below this relative to the size are touching.
constexpr double kTouching = 1e-14;
// Bytes for facets in exact ties, and for the polytope of a pair that has no memory of its own.
constexpr std::size_t kFacetsBytes = 64 * sizeof(MinimumTranslation);
constexpr std::size_t kPolytopeBytes = std::size_t{64} << 10;

// What lengths are compared with, metres.
struct Scale {
  explicit Scale(const PosedParts& parts)
      : size_m((parts.X_WB.position - parts.X_WA.position).lpNorm<1>() + parts.a.core.reach() +
               parts.b.core.reach()),
        noise_m(std::max(kNoise * size_m, kShortest)),
        shift_m(noise_m + kShift * (parts.X_WA.position.lpNorm<1>() + parts.X_WB.position.lpNorm<1>())) {}

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

// The polytope that proves a depth: the pair's own, or one of this query alone, made where it is needed
// first.
struct DepthProof {
  InnerPolytope* polytope = nullptr;
  Arena* arena = nullptr;
  std::optional<InnerPolytope> own{};

  InnerPolytope& get() {
    if (polytope == nullptr) polytope = &own.emplace(arena);
    return *polytope;
  }
};

MinimumTranslation minimumTranslation(const PolyhedronPair& pair, double noise_m, DepthProof& proof) {
  const bool solid = pair.a.faceCount() > 0 || pair.b.faceCount() > 0;
  return solid ? proof.get().minimumTranslation(pair, noise_m) : largestGap(pair);
}

// The canonical features of a depth; of facets that are equally near, the tracked one, else the lowest. Where
// rounding leaves no features that hold the witnesses, they lie between vertices.
void makeDepthCanonical(const PolyhedronPair& pair, const Scale& scale, InnerPolytope& polytope, bool tracked,
                        CoreAnswer& answer) {
  StackArena<kFacetsBytes> arena;
  MinimumTranslations facets(&arena);
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
// direction; the bodies do not intersect.
struct WalkEnd {
  const FeatureWalk& walk;
  bool inside;                                    // a point of both bodies was found
  const std::optional<MinimumTranslation>& axes;  // the minimum translation, if it has been asked for
};

void settle(const PolyhedronPair& pair, const WalkEnd& end, const Scale& scale, DepthProof& proof,
            CoreAnswer& answer) {
  const FeatureWalk& walk = end.walk;
  const FeatureDistance& found = walk.here();
  const bool directed = !end.inside && (found.distance() > kNoDirection * scale.size_m ||
                                        (found.distance() > scale.noise_m && acrossOf(pair, found).exact));
  if (directed) {
    answer = answerFrom(pair, found);
    makeCanonical(pair, answer, scale.noise_m, scale.shift_m);
    return;
  }
  const MinimumTranslation m = end.axes ? *end.axes : minimumTranslation(pair, scale.noise_m, proof);
  answer = answerFrom(m);
  if (m.gap_m < -scale.noise_m) return makeDepthCanonical(pair, scale, proof.get(), false, answer);
  if (end.inside) {  // they touch, to rounding
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
    if (warm->inside_m > scale.shift_m && certifiedAlone(pair, answer, scale.shift_m)) return true;
  }
  const bool parted = warm && warm->gap.gap_m > scale.noise_m;
  std::optional<MinimumTranslation> found;
  if (warm && warm->proven)
    found = polytope.minimumTranslation(pair, scale.noise_m, &warm->gap);
  else if (!parted && !(warm && warm->stale))
    found = polytope.follow(pair, scale.noise_m, warm ? &warm->gap : nullptr);
  if (found && found->gap_m < -scale.noise_m) {
    answer = answerFrom(*found);
    if (!certifiedInside(pair, answer, scale.shift_m) || !certifiedAlone(pair, answer, scale.shift_m))
      makeDepthCanonical(pair, scale, polytope, true, answer);
    return true;
  }
  polytope.forget();
  memory.features = parted ? warm->gap.features : FeaturePair{};
  return false;
}

// From the features of the last query to those of this one, which are not certified to be the same. One
// variable is returned everywhere: it is then built in its place, and what has just been written is not
// copied.
CoreAnswer closestCores(const PolyhedronPair& pair, const Scale& scale, FeaturePair tracked,
                        DepthProof& proof, Visits& visits) {
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
    axes = minimumTranslation(pair, scale.noise_m, proof);
    if (axes->gap_m < -scale.noise_m) {
      answer = answerFrom(*axes);
      makeDepthCanonical(pair, scale, proof.get(), false, answer);
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
  settle(pair, {walk, move == Move::kInside, axes}, scale, proof, answer);
  // The support planes leave no margin for a shorter way, or a longer search has to find it.
  visits.reached_limit =
      std::abs(answer.gap_m - slabAlong(pair, answer.features, answer.normal)) > kUnproven * scale.size_m;
  if (!visits.reached_limit) return answer;
  walk.startFrom(exhaustiveSearch(pair));
  settle(pair, {walk, walk.here().crossing, std::nullopt}, scale, proof, answer);
  return answer;
}

// Whether what was closest last time, or what it leads on to, is certified to be so; places are seen from A's
// origin.
PairsInPlace findInPlace(const PosedParts& parts, double noise_m, FeaturePair& features, PlacedGap& gap) {
  const PlacedPolyhedron placed_a(parts.a.core, parts.X_WA.rotation, Vec3::Zero());
  const PlacedPolyhedron placed_b(parts.b.core, parts.X_WB.rotation,
                                  parts.X_WB.position - parts.X_WA.position);
  return findCertifiedClosest(placed_a, placed_b, noise_m, features, gap);
}

// The answer of a query whose cores have this gap, seen from A's origin.
ClosestFeatures answerOf(const PosedParts& parts, const PlacedGap& gap, const Scale& scale,
                         FeaturePair features, const Visits& visits) {
  const double distance_m = gap.length_m - parts.a.radius_m - parts.b.radius_m;
  const double touching = kTouching * scale.size_m;
  const Vec3 p_A_W = gap.p_a + parts.a.radius_m * gap.normal + parts.X_WA.position;
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
PlacedGap keepFeatures(const CoreAnswer& core, const Pose& X_WA, FeaturePair& features) {
  features = core.features;
  const Rotation R_WA(X_WA.rotation);
  return {core.gap_m, R_WA * core.normal, R_WA * core.p_a};
}

// What is not clear in place: from the features that led there on.
ClosestFeatures search(const PosedParts& parts, const Scale& scale, int visited, FeaturePair& features,
                       DepthProof& proof) {
  Visits visits;
  const PolyhedronPair pair(parts.a.core, parts.X_WA, parts.b.core, parts.X_WB);
  const CoreAnswer core = closestCores(pair, scale, features, proof, visits);
  visits.states += visited;
  return answerOf(parts, keepFeatures(core, parts.X_WA, features), scale, core.features, visits);
}

// Apart, so that a query that is answered in place has less to clear up.
[[gnu::noinline]] ClosestFeatures searchFromMemory(const PosedParts& parts, const Scale& scale, int visited,
                                                   PairMemory& memory) {
  DepthProof proof{&memory.penetration};
  return search(parts, scale, visited, memory.features, proof);
}

ClosestFeatures query(const PosedParts& parts, PairMemory& memory) {
  const Scale scale(parts);
  PlacedGap gap;
  if (memory.penetration.triangleCount() > 0) {
    const PolyhedronPair pair(parts.a.core, parts.X_WA, parts.b.core, parts.X_WB);
    CoreAnswer core;
    if (followDepth(pair, scale, memory, core))
      return answerOf(parts, keepFeatures(core, parts.X_WA, memory.features), scale, core.features, {});
  }
  const PairsInPlace in_place = findInPlace(parts, scale.shift_m, memory.features, gap);
  if (in_place.found) return answerOf(parts, gap, scale, memory.features, {in_place.visited, false});
  return searchFromMemory(parts, scale, in_place.visited, memory);
}

// Debug builds hold every answer against its proof.
void holdAgainstItsProof([[maybe_unused]] const ClosestFeatures& answer,
                         [[maybe_unused]] const PosedParts& parts,
                         [[maybe_unused]] const PairMemory* memory) {
#ifndef NDEBUG
  const Certificate proof = certify(answer, parts.a, parts.X_WA, parts.b, parts.X_WB, memory);
  REQUIRE(proof.error_m <= certifiedError(parts.a, parts.X_WA, parts.b, parts.X_WB), proof.error_m,
          answer.distance_m);
#endif
}

// Of a query that what was closest last time, or what it leads on to, has answered: no depth, so no memory of
// one.
ClosestFeatures answerInPlace(const PosedParts& parts, const PlacedGap& gap, const Scale& scale,
                              const FeaturePair& features, int visited) {
  const ClosestFeatures result = answerOf(parts, gap, scale, features, {visited, false});
  holdAgainstItsProof(result, parts, nullptr);
  return result;
}

// The rest of a query by features alone: what it may need to prove a depth is its own.
ClosestFeatures searchByFeatures(const PosedParts& parts, const Scale& scale, int visited,
                                 FeaturePair& tracked) {
  StackArena<kPolytopeBytes> arena;
  DepthProof proof{nullptr, &arena};
  const ClosestFeatures result = search(parts, scale, visited, tracked, proof);
#ifndef NDEBUG
  const PairMemory left{tracked, proof.polytope != nullptr ? *proof.polytope : InnerPolytope()};
  holdAgainstItsProof(result, parts, &left);
#endif
  return result;
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                PairMemory& memory) {
  const PosedParts parts{a, X_WA, b, X_WB};
  const ClosestFeatures result = query(parts, memory);
  holdAgainstItsProof(result, parts, &memory);
  return result;
}

ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked) {
  const PosedParts parts{a, X_WA, b, X_WB};
  const Scale scale(parts);
  PlacedGap gap;
  const PairsInPlace in_place = findInPlace(parts, scale.shift_m, tracked, gap);
  if (!in_place.found) return searchByFeatures(parts, scale, in_place.visited, tracked);
  return answerInPlace(parts, gap, scale, tracked, in_place.visited);
}

}  // namespace carom
