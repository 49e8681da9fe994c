#pragma once
// The fallback of a walk that was cut short: every feature against every feature. It is counted where it is
// used (`reached_limit`): never of a cold or tracked start in the adversarial families, about once in 1e5
// arbitrary starts between nearly parallel faces. Tested in
// tests/engine/closest_features/separated/exhaustive_search_test.cpp.

#include "engine/closest_features/pair/feature_distance.h"

namespace carom {

/// The closest features of two polyhedra; `crossing` if they intersect, one inside the other too. Cost: the
/// product of their feature counts.
FeatureDistance exhaustiveSearch(const PolyhedronPair& pair);

}  // namespace carom
