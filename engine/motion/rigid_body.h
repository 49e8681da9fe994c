#pragma once
// Mass and velocity of a rigid body, and torque-free rotation.
// Tested in tests/engine/motion/rigid_body_test.cpp.

#include "engine/foundation/frames.h"

namespace carom {

/// Constant for a body; a static body has both inverses zero.
struct Inertia {
  double mass_kg = 0.0;
  double inverse_mass = 0.0;
  Mat3 tensor_B = Mat3::Zero();  ///< kg m^2 about the centre of mass.
  Mat3 inverse_tensor_B = Mat3::Zero();
  Mat3 principal_axes_B = Mat3::Identity();  ///< Columns: right-handed, by rising moment.
  Vec3 principal_moments = Vec3::Zero();
};
Inertia inertiaOf(double density_kgpm3, double volume, const Mat3& unit_inertia);

struct Velocity {
  Vec3 linear = Vec3::Zero();   ///< m/s of the centre of mass.
  Vec3 angular = Vec3::Zero();  ///< rad/s, world frame.

  /// v = v_lin + omega x r (DEVIATES: the paper prints r x v_ang, the sign of a left-handed convention).
  Vec3 at(const Vec3& r_W) const { return linear + angular.cross(r_W); }
};

Mat3 inverseTensorInWorld(const Inertia& inertia, const Quat& R_WB);
/// I omega, world frame.
Vec3 angularMomentum(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity);
/// The angular velocity that carries angular momentum L in an orientation.
Vec3 angularVelocity(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_momentum);
double kineticEnergy(const Inertia& inertia, const Quat& R_WB, const Velocity& velocity);

/// The rotation of a free body that tumbles: where it leaves an orientation at any time after, smoothly in
/// time.
struct Tumbling {
  const Inertia* inertia = nullptr;
  Vec3 momentum = Vec3::Zero();  ///< Angular, kg m^2/s, world frame: conserved.
  double fastest_spin = 0.0;     ///< rad/s: a bound, from the energy.
  int parts = 1;                 ///< Steps of the integrator, whatever the time.
};
/// Accurate for times up to `longest_s`.
Tumbling tumbling(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double longest_s);
Quat rotationAfter(const Tumbling& tumbling, const Quat& R_WB, double dt_s);
/// By how many radians, at most, constant spin misses the torque-free orientation on its way through `dt_s`:
/// |d omega / dt| dt^2 / 8.
double tumblingMiss(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s);

/// The constant spin that carries a free body from `R_WB` to where `dt_s` seconds of torque-free rotation
/// leave it, by splitting the kinetic energy into a part that turns the body about its angular momentum and
/// two that turn it about principal axes, each solved exactly: time-reversible, fourth order, exact for a
/// body with an axis of symmetry. With omega recomputed from the conserved angular momentum at the end, that
/// momentum is exact and the energy bounded. Beyond two radians a step the spin of the first two is kept.
Vec3 torqueFreeSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s);

/// What `dt_s` seconds of torque-free rotation make of an angular velocity, both in the body's own frame: its
/// kinetic energy is the same (Euler's equations, by the same splitting). Where a contact leads a body's
/// orientation, the body has this angular velocity in it: recomputed from an angular momentum in the world,
/// that of a needle would gain a hundred times its energy for every few degrees by which the two differ.
Vec3 torqueFreeSpinInBody(const Inertia& inertia, const Vec3& spin_B, double dt_s);

}  // namespace carom
