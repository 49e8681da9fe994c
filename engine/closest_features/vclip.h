#pragma once
// V-Clip (paper §2; Mirtich 1997): the closest features of two convex parts, found by walking from a feature pair to
// a neighbouring pair that is closer, until each witness lies in the V-region of the other's feature.
//
// Why it ends, in floating point too: the distance of the two closed features is a pure function of the feature pair,
// and a move is taken only if that number strictly falls; there are finitely many pairs. Where it ends is the answer:
// a V-region violated by more than rounding always offers a strictly closer pair, and by convexity two points each in
// the other's V-region are the closest points of the whole bodies. A witness behind a face (the classic local
// minimum) is either inside, or the line from it to the face enters the body earlier, through a face that is closer.
// A walk that reaches its bound all the same is counted and answered by exhaustive search.
// Tested in tests/engine/closest_features/vclip_test.cpp.

#include "engine/closest_features/feature.h"
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

/// The closest features of two parts. `tracked` is where the walk starts and receives where it ended; a pair with
/// index -1 starts it from the vertices that face each other.
ClosestFeatures closestFeatures(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                                FeaturePair& tracked);

}  // namespace carom
