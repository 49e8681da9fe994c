#pragma once
// Where the closest points are not unique (parallel faces and edges, exact lattice poses) or lie on the
// border of V-regions, rounding and the start of the walk would choose the features. Here one choice is made
// from geometry alone: all features within the noise of the two support planes are gathered, and among the
// corners of their overlap the one with the lowest vertex index is taken, with the lowest feature of the
// other body that holds it. So the answer does not change with the start of the walk, when both bodies move
// together, or by motion below the noise; swapping the bodies swaps the features. (Equal solids in a pose
// that a swap maps onto itself have two equal answers; that of body A then counts.) Tested in
// tests/engine/closest_features/canonical_features_test.cpp.

#include "engine/closest_features/pair/core_answer.h"

namespace carom {

/// Replaces the features and witnesses of an answer by the canonical ones. Features within `noise_m` of a
/// support plane are level with it, points within `shift_m` of each other across the normal coincide. The gap
/// and normal change only by less than the noise (a normal taken from two witnesses becomes that of a face
/// that is level with them). False: no features hold the witnesses across the normal, nothing was changed.
bool makeCanonical(const PolyhedronPair& pair, CoreAnswer& answer, double noise_m, double shift_m);

/// Whether features come before others that are as good, in an order that swapping the bodies keeps.
bool comesBefore(const PolyhedronPair& pair, const FeaturePair& x, const FeaturePair& y);

}  // namespace carom
