#pragma once
// V-Clip (paper §2; Mirtich 1997): the closest features of two convex parts, found by walking from a feature
// pair to a neighbouring pair that is closer, until each witness lies in the V-region of the other's feature.
//
// Why it ends, in floating point too: the distance of the two closed features is a pure function of the
// feature pair, and a move is taken only if that number strictly falls; there are finitely many pairs. Where
// it ends is the answer: by convexity two points each in the other's V-region are the closest points of the
// whole bodies, and a violated V-region offers a closer pair. Three ways that rounding or degeneracy hide it
// are looked for at the end of a walk:
// - the way between the witnesses runs inside a body (the classic local minimum behind a face; also at the
// flat edges
//   of coplanar faces, whose V-planes do not tell out from in): the other witness is inside, or the way
//   enters the body earlier, through a face that is closer;
// - between almost parallel features a step on one body gains half the slope squared, below rounding, a step
// on both
//   the slope itself: the free slab between the support planes bounds the error and asks for a step on both;
// - witnesses too close together have no direction: the separating axes give it, and the depth if there is
// one. A walk that reaches its bound all the same is counted and answered by exhaustive search. Tested in
// tests/engine/closest_features/vclip_test.cpp.

#include "engine/closest_features/feature.h"
#include "engine/closest_features/inner_polytope.h"
#include "engine/solid/solid.h"

namespace carom {

enum class Separation : std::uint8_t { kSeparated, kTouching, kPenetrating };

struct ClosestFeatures {
  Separation status = Separation::kSeparated;
  double distance_m = 0.0;  ///< Negative: the exact penetration depth along `n_W`.
  Vec3 p_A_W = Vec3::Zero();
  Vec3 p_B_W = Vec3::Zero();
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  FeaturePair features;
  int states = 0;              ///< Feature pairs visited.
  bool reached_limit = false;  ///< The walk was cut short and the exhaustive search answered.
};

/// What a caller keeps of a pair from one query to the next: where the walk ended and, of a pair that
/// intersects, the polytope that proved its depth. As made, the next query starts cold.
struct PairMemory {
  FeaturePair features;
  InnerPolytope penetration;
};

/// The closest features of two parts. The work is done from `memory` on, and left there for the next query
/// of the same pair; what is found does not depend on it. Allocates nothing once the pair's memory has grown.
ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                PairMemory& memory);

/// The same for pairs that stay apart: a penetrating one pays for its depth anew.
ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked);

}  // namespace carom
