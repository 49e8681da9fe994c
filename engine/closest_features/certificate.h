#pragma once
// A proof that an answer is right, at a cost linear in the features, that shares nothing with the search for
// it: no adjacency, no tracking, every vertex and face is looked at.
//
// Separated: the witnesses lie in their parts, so the distance is at most theirs; both parts lie beyond their
// support planes across the normal, so it is at least the width of the slab between. Penetrating: moving B by
// the depth along the normal frees it, so the depth is at most that; and the tracked polytope
// (inner_polytope.h) is a closed surface of points of A - B whose planes all pass at least that far outside
// the origin: all its triangles are seen from their inner sides, so it winds around, and the ball below the
// planes lies within A - B. Queries that prove their depth otherwise (warm_facet.h) leave the polytope as it
// was; a new one is then made for the proof, which is the one thing here that is not linear. Tested in
// tests/engine/closest_features/certificate_test.cpp.

#include "engine/closest_features/vclip.h"

namespace carom {

struct Certificate {
  /// The distance (or depth), the witnesses and the normal are right to within this, metres.
  double error_m = 0.0;
  /// False: the depth is proven to free the parts but not to be the least that does (no polytope was given,
  /// or parts without faces).
  bool complete = true;
};

/// `memory`: as the query left it; only the depth of a penetrating pair needs it.
Certificate certify(const ClosestFeatures& answer, const ConvexPart& a, const Pose& X_WA, const ConvexPart& b,
                    const Pose& X_WB, const PairMemory* memory = nullptr);

/// What rounding alone may put into `Certificate::error_m`, metres: 1e-12 of the pair's size and a few units
/// in the last place of the positions. A larger error is a wrong answer.
double certifiedError(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB);

}  // namespace carom
