#pragma once
// Poses that are only moved.

#include "engine/foundation/frames.h"

namespace carom {

inline Pose poseAt(double x, double y, double z, const Quat& rotation = Quat::Identity()) {
  return {rotation, Vec3(x, y, z)};
}

}  // namespace carom
