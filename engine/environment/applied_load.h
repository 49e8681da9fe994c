#pragma once
// A constant force at the centre of mass and a constant torque on one body: in the world's axes, as gravity,
// or in the body's own, as a thruster's. Tested in tests/physics/applied_load_test.cpp.

#include "engine/foundation/frames.h"

namespace carom {

struct AppliedLoad {
  Vec3 force_W = Vec3::Zero();   ///< N, world frame.
  Vec3 torque_W = Vec3::Zero();  ///< N m, world frame.
  Vec3 force_B = Vec3::Zero();   ///< N, in the axes of the body.
  Vec3 torque_B = Vec3::Zero();  ///< N m, in the axes of the body.

  bool isZero() const { return force_W.isZero(0.0) && !bends(); }
  /// Whether more than a constant force in the world acts: then no parabola is the body's path.
  bool bends() const { return !torque_W.isZero(0.0) || !force_B.isZero(0.0) || !torque_B.isZero(0.0); }
  /// Whether a part of it turns with the body.
  bool turnsAlong() const { return !force_B.isZero(0.0) || !torque_B.isZero(0.0); }
  Vec3 force(const Quat& R_WB) const { return force_W + R_WB * force_B; }
  Vec3 torque(const Quat& R_WB) const { return torque_W + R_WB * torque_B; }
};

}  // namespace carom
