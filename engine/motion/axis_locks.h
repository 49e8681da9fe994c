#pragma once
// Axes of the world that a body cannot move along or turn about, whatever acts on it. Of turning, all axes,
// none or all but one may be locked: then the body turns about one axis that stays where it is in the world
// and in the body, with a constant moment of inertia. (Two free axes would make the motion nonholonomic: the
// third turns away with the body.) Tested in tests/engine/motion/axis_locks_test.cpp.

#include <cmath>

#include "engine/motion/rigid_body.h"

namespace carom {

struct AxisLocks {
  enum class Turning : std::uint8_t { kFree, kOneAxis, kLocked };

  Vec3 free_axes = Vec3::Ones();  ///< 1 along the world's axes that it may move along, else 0.
  Turning turning = Turning::kFree;
  Vec3 axis_W = Vec3::UnitZ();  ///< Unit: the one it turns about.

  bool any() const { return turning != Turning::kFree || !(free_axes.array() == 1.0).all(); }
  /// What of a velocity, force or acceleration is left.
  Vec3 movingPart(const Vec3& v_W) const { return free_axes.cwiseProduct(v_W); }
  /// What of an angular velocity or torque is left.
  Vec3 turningPart(const Vec3& v_W) const {
    if (turning == Turning::kFree) return v_W;
    if (turning == Turning::kLocked) return Vec3::Zero();
    return dot(axis_W, v_W) * axis_W;
  }
  /// Of the turning from one rotation to another, what may be made of it: the rotation that it leads to. The
  /// axis in the body would leave that of the world, step by step, by the rounding of each.
  Quat turnedFrom(const Quat& before, const Quat& after) const {
    if (turning == Turning::kFree) return after;
    if (turning == Turning::kLocked) return before;
    const Quat turned = after * before.conjugate();
    const double along = dot(axis_W, Vec3(turned.vec()));
    const double length = std::sqrt(turned.w() * turned.w() + along * along);
    if (!(length > 0.0)) return before;
    const Vec3 part = along / length * axis_W;
    return Quat(turned.w() / length, part.x(), part.y(), part.z()) * before;
  }
};

/// The inertia of a body that turns only as `locks` let it. About one axis: its moment about that one, and no
/// response about the others; the tensor is that moment's about every axis, so that angular momentum, energy
/// and free rotation about the one are as they are.
inline Inertia lockedInertia(const Inertia& inertia, const AxisLocks& locks, const Quat& R_WB) {
  Inertia locked = inertia;
  if (locks.turning == AxisLocks::Turning::kLocked) locked.inverse_tensor_B.setZero();
  if (locks.turning != AxisLocks::Turning::kOneAxis) return locked;
  const Vec3 axis_B = R_WB.conjugate() * locks.axis_W;
  const double moment = dot(axis_B, inertia.tensor_B * axis_B);
  locked.tensor_B = moment * Mat3::Identity();
  locked.inverse_tensor_B = axis_B * axis_B.transpose() / moment;
  locked.principal_axes_B.setIdentity();
  locked.principal_moments.setConstant(moment);
  return locked;
}

/// What torque impulses about the world's axes make of the angular velocity: exactly nothing about a locked
/// one.
inline Mat3 turningResponse(const Inertia& inertia, const AxisLocks& locks) {
  if (locks.turning == AxisLocks::Turning::kLocked) return Mat3::Zero();
  return locks.axis_W * locks.axis_W.transpose() / inertia.principal_moments[0];
}

}  // namespace carom
