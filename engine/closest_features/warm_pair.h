#pragma once
// The usual case of a coherent query, by itself: the pair that was closest last time still is, and by more
// than rounding could hide. Each case measures the witnesses inside their features and the slopes along all
// ways off them at once; anything less than clear is left to the walk. Tested in
// tests/engine/closest_features/warm_pair_test.cpp.

#include "engine/closest_features/core_answer.h"

namespace carom {

/// Whether `features` are clearly the closest: witnesses farther than `noise_m` inside their features, and
/// every end of a feature's neighbours farther than that behind its support plane. Fills `answer` if so.
bool clearlyClosest(const PolyhedronPair& pair, FeaturePair features, double noise_m, CoreAnswer& answer);

/// The same question about the facet of a minimum translation: whether `features`, F-V or E-E with their
/// witnesses in `answer`, clearly are the only ones that touch along its normal.
bool clearlyAlone(const PolyhedronPair& pair, const CoreAnswer& answer, double noise_m);

}  // namespace carom
