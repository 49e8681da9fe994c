#pragma once
// The path of a body over a time interval: constant acceleration and constant spin, evaluated exactly at any
// instant. In flight the acceleration is gravity (an exact parabola); in lasting contact it is zero. Tested
// in tests/engine/motion/trajectory_test.cpp.

#include "engine/foundation/elementary.h"
#include "engine/foundation/frames.h"

namespace carom {

struct Trajectory {
  double start_s = 0.0;
  Pose X_WB;                     ///< At `start_s`.
  Vec3 velocity = Vec3::Zero();  ///< Of the centre of mass at `start_s`.
  Vec3 acceleration = Vec3::Zero();
  Vec3 spin = Vec3::Zero();  ///< rad/s, world frame, constant.

  Vec3 positionAt(double t_s) const {
    const double t = t_s - start_s;
    if (t == 0.0) return X_WB.position;
    return X_WB.position + t * velocity + (0.5 * t * t) * acceleration;
  }
  Pose at(double t_s) const {
    const double t = t_s - start_s;
    Pose X{X_WB.rotation, positionAt(t_s)};
    if (t == 0.0) return X;
    if (!spin.isZero(0.0)) X.rotation = (rotationBy(t * spin) * X_WB.rotation).normalized();
    return X;
  }
  Vec3 velocityAt(double t_s) const { return velocity + (t_s - start_s) * acceleration; }
  bool still() const { return velocity.isZero(0.0) && acceleration.isZero(0.0) && spin.isZero(0.0); }
};

}  // namespace carom
