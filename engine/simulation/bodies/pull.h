#pragma once
// How hard bodies are pushed together at most: what gravity and constant loads make of their velocities.
// Approaches that these make within a step are lasting contact, slower than that nothing collides; and what
// contact leaves unsolved is small beside it. Internal to the simulation floor. Tested in
// tests/engine/simulation/bodies/pull_test.cpp.

#include <algorithm>

#include "engine/environment/applied_load.h"
#include "engine/foundation/frames.h"
#include "engine/motion/rigid_body.h"

namespace carom {

/// Of one body; nothing of what does not yield.
struct Pull {
  Vec3 steady = Vec3::Zero();  ///< m/s^2, world frame: gravity, and the constant part of its load.
  double turning_mps2 = 0.0;   ///< What any point of it has at most from loads that turn it, or with it.
  double most_mps2 = 0.0;      ///< Of both together.
};

/// Of a body whose points are within `radius_m` of its centre of mass.
inline Pull pullOf(const AppliedLoad& load, const Vec3& gravity, const Inertia& inertia, double radius_m) {
  if (load.isZero()) return {gravity, 0.0, gravity.norm()};
  const Vec3 steady = gravity + inertia.inverse_mass * load.force_W;
  const double torque = load.torque_W.norm() + load.torque_B.norm();
  const double turning =
      inertia.inverse_mass * load.force_B.norm() + radius_m * inertia.inverse_tensor_B.norm() * torque;
  return {steady, turning, steady.norm() + turning};
}

/// By which two bodies can be pushed together, m/s^2, each by itself or by what the other is held by.
inline double pullBetween(const Pull& a, const Pull& b) {
  const double steady = std::max({a.steady.norm(), b.steady.norm(), (a.steady - b.steady).norm()});
  return steady + a.turning_mps2 + b.turning_mps2;
}

}  // namespace carom
