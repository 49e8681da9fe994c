#pragma once
// The motions that the benchmarks time: closed loops of pose pairs, the same for every library.

#include <cstdint>
#include <vector>

#include "engine/solid/solid.h"
#include "tests/bench/peers/library.h"

namespace carom::bench {

enum class Motion {
  kCoherentSeparated,  ///< A degree a query about changing axes, gaps of 0.05 to 1 size.
  kRandomSeparated,    ///< Fresh orientations and gap each time, nothing remembered.
  kCoherentShallow,    ///< As coherent, depths of 1 to 10 % of the size.
  kCoherentDeep,       ///< As coherent, depths of 20 to 50 % of the size.
  kCount
};

const char* motionName(Motion motion);

/// Poses in a lap. A coherent lap is run forth and back, so that it closes without a jump.
constexpr int kLap = 2048;

/// A hull of n vertices and circumradius 0.5: a box for 8, a dodecahedron for 20, else points spread evenly
/// over the sphere and jittered.
ConvexPart benchPart(int n);

/// A lap for two copies of the part.
std::vector<PosePair> poseLoop(Motion motion, const ConvexPart& part, std::uint64_t seed);

}  // namespace carom::bench
