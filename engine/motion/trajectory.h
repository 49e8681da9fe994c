#pragma once
// The path of a body over a time interval: constant acceleration, and constant spin, torque-free tumbling or
// a spin that changes evenly about its axis, evaluated exactly at any instant. In flight the acceleration is
// gravity (an exact parabola), in air and water the mean one; in lasting contact it is zero. A prescribed
// path (prescribed_path.h) is made of such pieces. Tested in tests/engine/motion/trajectory_test.cpp.

#include "engine/foundation/elementary.h"
#include "engine/foundation/frames.h"
#include "engine/motion/free_rotation.h"
#include "engine/motion/rigid_body.h"

namespace carom {

/// A spin that changes evenly, along its own axis.
struct SpinChange {
  Vec3 rate = Vec3::Zero();   ///< rad/s^2.
  double fastest_spin = 0.0;  ///< rad/s: a bound over the whole interval.
};

struct Trajectory {
  double start_s = 0.0;
  Pose X_WB;                     ///< At `start_s`.
  Vec3 velocity = Vec3::Zero();  ///< Of the centre of mass at `start_s`.
  Vec3 acceleration = Vec3::Zero();
  Vec3 spin = Vec3::Zero();     ///< rad/s, world frame, constant; of a body that tumbles, the mean.
  FreeRotation tumbling = {};   ///< From `X_WB` on; empty: it turns at its spin.
  SpinChange spin_change = {};  ///< Of a body that does not tumble; `spin` is that at `start_s`.

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
    else if (!spin_change.rate.isZero(0.0))
      X.rotation = (rotationBy(t * spin + (0.5 * t * t) * spin_change.rate) * X_WB.rotation).normalized();
    else if (!spin.isZero(0.0))
      X.rotation = (rotationBy(t * spin) * X_WB.rotation).normalized();
    return X;
  }
  Vec3 velocityAt(double t_s) const { return velocity + (t_s - start_s) * acceleration; }
  /// Of the centre of mass from `t_s` on, over `dt_s` seconds.
  Vec3 meanVelocity(double t_s, double dt_s) const { return velocityAt(t_s) + 0.5 * dt_s * acceleration; }
  Vec3 angularVelocityAt(double t_s) const {
    if (!tumbling.empty()) return tumbling.angularVelocityIn(at(t_s).rotation);
    return spin_change.rate.isZero(0.0) ? spin : Vec3(spin + (t_s - start_s) * spin_change.rate);
  }
  double fastestSpin() const {
    if (!tumbling.empty()) return tumbling.fastestSpin();
    return spin_change.rate.isZero(0.0) ? spin.norm() : spin_change.fastest_spin;
  }
  /// What turning can accelerate a point by, m/s^2 for each metre from the centre of mass: centripetally by
  /// omega^2, and no more than that again by d omega / dt, as no principal moment exceeds the others' sum.
  double turningAcceleration() const {
    const double fastest = fastestSpin();
    if (!tumbling.empty()) return 2.0 * fastest * fastest;
    return spin_change.rate.isZero(0.0) ? spin.squaredNorm() : fastest * fastest + spin_change.rate.norm();
  }
  /// From now on at a constant spin.
  void turnAt(const Vec3& constant_spin) {
    spin = constant_spin;
    tumbling = {};
    spin_change = {};
  }
  bool still() const {
    return velocity.isZero(0.0) && acceleration.isZero(0.0) && spin.isZero(0.0) &&
           spin_change.rate.isZero(0.0);
  }
};

}  // namespace carom
