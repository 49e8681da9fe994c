#pragma once
// The path of a body over a time interval: constant acceleration, and constant spin or torque-free tumbling,
// evaluated exactly at any instant. In flight the acceleration is gravity (an exact parabola), in air and
// water the mean one; in lasting contact it is zero. Tested in tests/engine/motion/trajectory_test.cpp.

#include "engine/foundation/elementary.h"
#include "engine/foundation/frames.h"
#include "engine/motion/free_rotation.h"
#include "engine/motion/rigid_body.h"

namespace carom {

struct Trajectory {
  double start_s = 0.0;
  Pose X_WB;                     ///< At `start_s`.
  Vec3 velocity = Vec3::Zero();  ///< Of the centre of mass at `start_s`.
  Vec3 acceleration = Vec3::Zero();
  Vec3 spin = Vec3::Zero();    ///< rad/s, world frame, constant; of a body that tumbles, the mean.
  FreeRotation tumbling = {};  ///< From `X_WB` on; empty: it turns at its spin.

  Vec3 positionAt(double t_s) const {
    const double t = t_s - start_s;
    if (t == 0.0) return X_WB.position;
    return X_WB.position + t * velocity + (0.5 * t * t) * acceleration;
  }
  Pose at(double t_s) const {
    const double t = t_s - start_s;
    Pose X{X_WB.rotation, positionAt(t_s)};
    if (t == 0.0) return X;
    if (!tumbling.empty())
      X.rotation = tumbling.after(t);
    else if (!spin.isZero(0.0))
      X.rotation = (rotationBy(t * spin) * X_WB.rotation).normalized();
    return X;
  }
  Vec3 velocityAt(double t_s) const { return velocity + (t_s - start_s) * acceleration; }
  Vec3 angularVelocityAt(double t_s) const {
    return tumbling.empty() ? spin : tumbling.angularVelocityIn(at(t_s).rotation);
  }
  double fastestSpin() const { return tumbling.empty() ? spin.norm() : tumbling.fastestSpin(); }
  /// What turning can accelerate a point by, m/s^2 for each metre from the centre of mass: centripetally by
  /// omega^2, and no more than that again by d omega / dt, as no principal moment exceeds the others' sum.
  double turningAcceleration() const {
    const double fastest = tumbling.fastestSpin();
    return tumbling.empty() ? spin.squaredNorm() : 2.0 * fastest * fastest;
  }
  /// From now on at a constant spin.
  void turnAt(const Vec3& constant_spin) {
    spin = constant_spin;
    tumbling = {};
  }
  bool still() const { return velocity.isZero(0.0) && acceleration.isZero(0.0) && spin.isZero(0.0); }
};

}  // namespace carom
