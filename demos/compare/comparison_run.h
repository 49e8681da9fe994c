#pragma once
// Many pairs compared by as many threads as there are cores. A thread holds one pair at a time, so memory
// does not grow with the number of frames, and each result has its place, so the outcome does not depend on
// the threads. Tested in tests/demos/compare/comparison_test.cpp.

#include <functional>
#include <vector>

#include "demos/compare/comparison.h"

namespace carom::demos {

/// In the order of the pairs. `done` is told how many are finished, on one thread at a time. Throws
/// Interrupted.
std::vector<Comparison> comparedPairs(const std::vector<ImagePair>& pairs, const Gate& gate,
                                      const std::function<void(int)>& done);

}  // namespace carom::demos
