#pragma once
// Mass and velocity of a rigid body.
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

  /// It turns as a ball does: at a constant spin.
  bool isIsotropic() const { return principal_moments[0] == principal_moments[2]; }
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

/// The angular velocity, world frame, that has this energy of rotation and the angular momentum nearest to
/// the one given. For a body whose orientation contacts have led elsewhere than its own rotation would have:
/// with the same angular momentum a needle would have a hundred times its energy for every few degrees of
/// difference, as its moment about its own axis is so small. Less energy than asked for where the momentum
/// would have to change beyond what such a difference explains. `kept_W`, if it is not zero: the part of the
/// angular momentum along it stays as it is, where that leaves room for the energy.
Vec3 spinOfEnergy(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_momentum, double energy_J,
                  const Vec3& kept_W = Vec3::Zero());

}  // namespace carom
