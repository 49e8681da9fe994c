#pragma once
// A random sequence of closest-feature queries of one pair with one memory: poses on a lattice, jumps, slow
// motion, and returns to poses of before. Each answer is held against one with a fresh memory, some against
// brute force in long double. Tested in tests/explore/trial/query_trial_test.cpp.

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/closest_features/vclip.h"
#include "tests/explore/trial/world_trial.h"

namespace carom::explore {

struct QuerySequence {
  ConvexPart a, b;
  std::vector<Pose> X_AB;  ///< A stands at the origin.
};

QuerySequence randomQueries(std::uint64_t seed);
/// What is asked: A at the origin, B at the pose.
using Query = std::function<ClosestFeatures(const ConvexPart&, const ConvexPart&, const Pose&, PairMemory&)>;
ClosestFeatures askEngine(const ConvexPart& a, const ConvexPart& b, const Pose& X_AB, PairMemory& memory);

TrialOutcome tryQueries(const QuerySequence& sequence, const Query& query = askEngine);
inline TrialOutcome tryQueries(std::uint64_t seed) {
  return tryQueries(randomQueries(seed));
}
/// As few of its poses as still give a finding of that kind.
QuerySequence shrunkQueries(QuerySequence sequence, const std::string& kind, const Query& query = askEngine);
/// The parts' corners and the poses, as text.
std::string queryText(const QuerySequence& sequence);

}  // namespace carom::explore
