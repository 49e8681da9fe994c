#pragma once
// Uniform gravity, the external force of the paper (§2.4: applied once per step to bodies in lasting
// contact). DEVIATES: bodies in flight follow the exact parabola instead (see motion/trajectory.h). Tested in
// tests/physics/flight/free_fall_test.cpp.

#include "engine/motion/rigid_body.h"

namespace carom {

/// The velocity that gravity adds to a body of finite mass in `dt_s` seconds.
inline Vec3 gravityImpulsePerMass(const Vec3& gravity, double dt_s) {
  return dt_s * gravity;
}

/// -m g . x: zero at the world's origin.
inline double gravityPotential(const Inertia& inertia, const Vec3& gravity, const Vec3& p_W) {
  return -inertia.mass_kg * dot(gravity, p_W);
}

}  // namespace carom
