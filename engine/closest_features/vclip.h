#pragma once
// The closest features of two convex parts: the query that everything above asks (paper §2). The pair that
// was closest last time, or one that it leads on to, gets proven so in place (warm_pair.h); where nothing is
// clear a walk looks for the closest features (feature_walk.h holds the argument that it ends); bodies that
// intersect get their exact depth (inner_polytope.h). What is found is then named by canonical features
// (canonical_features.h), so that the answer does not depend on where the search began. Certificates
// (certificate.h) prove answers; debug builds check every one. A walk that finds no way on is counted and
// answered by exhaustive search. Tested in tests/engine/closest_features/vclip_test.cpp.

#include "engine/closest_features/pair/feature.h"
#include "engine/closest_features/penetrating/inner_polytope.h"
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
/// intersects, the polytope that last proved its depth. As made, the next query starts cold.
struct PairMemory {
  FeaturePair features;
  InnerPolytope penetration;
};

/// Two parts where they are.
struct PosedParts {
  const ConvexPart& a;
  const Pose& X_WA;
  const ConvexPart& b;
  const Pose& X_WB;
};

/// The closest features of two parts. The work is done from `memory` on, and left there for the next query
/// of the same pair; what is found does not depend on it, but that of ways out that are equally short to the
/// rounding the one taken last stays. Allocates nothing once the pair's memory has grown.
ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                PairMemory& memory);

/// The same for pairs that stay apart: a penetrating one pays for its depth anew. Allocates nothing but for
/// the depth of solids of hundreds of vertices.
ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked);

}  // namespace carom
