#pragma once
// The flight of one body through its environment, without contacts, over one step: strokes of torque-free
// drift about kicks in the middle of each (Strang), so that without drag it is time-reversible and keeps its
// energy. In a kick the pose is held and the velocity taken by Kahan's method, which is linearly implicit:
//   (M + k S(U0) + k w B) U1 = (M - k (1 - w) B) U0 + k F,
// U relative to the stream. S and B are not negative, so a kick of any length and speed is stable; where
// drag balances the load it stands still, so the terminal velocity is exact; and on a line it follows tanh to
// third order. Tested in tests/physics/water/terminal_velocity_test.cpp and
// tests/physics/water/floating_test.cpp.

#include "engine/environment/body_forces.h"
#include "engine/motion/free_rotation.h"

namespace carom {

struct EnvironmentFlight {
  Pose X_end;
  Vec3 velocity_end = Vec3::Zero();          ///< m/s of the centre of mass.
  Vec3 angular_momentum_end = Vec3::Zero();  ///< World frame.
  double turning_energy_end_J = 0.0;         ///< With X_end; drag has taken its part of it.
  /// The constant spin that leads to X_end in air and fluids, where that is within two radians and near the
  /// body's own way there.
  Vec3 spin = Vec3::Zero();
  /// Else, unless the inertia is isotropic: the free rotation with the mean of the angular momenta, in air
  /// and fluids the nearest to it that has the mean energy, which leads near X_end. Half of what acts then
  /// acts before and half after it, which is Strang's splitting as well and as free of drift. `spin` is its
  /// mean, as far as it has one.
  FreeRotation tumbling = {};
  int strokes = 0;
};

/// What contacts add all the while, in the world frame about the centre of mass.
struct ContactLoad {
  Vec3 force_N = Vec3::Zero();
  Vec3 torque_Nm = Vec3::Zero();
};

/// A body with all that acts on it.
struct PushedBody {
  const Environment& environment;
  const EnvironmentBody& body;
  const ContactLoad& contacts;
};

/// From `X_WB` with `velocity` (angular in the world frame) for `dt_s` seconds, beginning at `t_s`.
EnvironmentFlight flyThroughEnvironment(const PushedBody& pushed, const Pose& X_WB, const Velocity& velocity,
                                        double t_s, double dt_s, ForceScratch& scratch);

}  // namespace carom
