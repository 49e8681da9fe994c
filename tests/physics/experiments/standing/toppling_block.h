#pragma once
// A block that cannot slide falls over exactly when the line of its weight leaves its base: tan > b / h.

#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {

/// tan of the steepest slope on which it stands, over b / h, less one; to 1e-4.
inline double topplingError(const Simulator& simulator, Slope slope, const Vec3& size = {0.3, 0.4, 0.9}) {
  slope.friction = 1.5;
  const auto stands = [&](double share) {
    slope.angle = std::atan(share * size.x() / size.z());
    Trial trial = blockOn(slope, simulator, size);
    const Quat begin = trial.motion(kOnSlope).X_WB.rotation;
    trial.run(4.0);
    return trial.motion(kOnSlope).X_WB.rotation.angularDistance(begin) < 0.3;
  };
  return thresholdOf(0.8, 1.2, 12, stands) - 1.0;
}

}  // namespace carom::physics
