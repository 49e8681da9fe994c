#include "engine/motion/rigid_body.h"

#include <Eigen/LU>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

// The midpoint equation contracts by about |spin| dt / 2 per pass.
constexpr int kMidpointPasses = 12;

}  // namespace

Inertia inertiaOf(double density_kgpm3, double volume, const Mat3& unit_inertia) {
  Inertia inertia;
  inertia.mass_kg = density_kgpm3 * volume;
  inertia.inverse_mass = 1.0 / inertia.mass_kg;
  inertia.tensor_B = density_kgpm3 * unit_inertia;
  inertia.inverse_tensor_B = inertia.tensor_B.inverse();
  return inertia;
}

Mat3 inverseTensorInWorld(const Inertia& inertia, const Quat& R_WB) {
  const Mat3 R = R_WB.toRotationMatrix();
  return R * inertia.inverse_tensor_B * R.transpose();
}

Vec3 angularMomentum(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity) {
  const Mat3 R = R_WB.toRotationMatrix();
  return R * (inertia.tensor_B * (R.transpose() * angular_velocity));
}

Vec3 angularVelocity(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_momentum) {
  const Mat3 R = R_WB.toRotationMatrix();
  return R * (inertia.inverse_tensor_B * (R.transpose() * angular_momentum));
}

double kineticEnergy(const Inertia& inertia, const Quat& R_WB, const Velocity& velocity) {
  return 0.5 * inertia.mass_kg * velocity.linear.squaredNorm() +
         0.5 * velocity.angular.dot(angularMomentum(inertia, R_WB, velocity.angular));
}

Vec3 torqueFreeSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  if (angular_velocity.isZero(0.0)) return angular_velocity;
  const Vec3 momentum = angularMomentum(inertia, R_WB, angular_velocity);
  Vec3 spin = angular_velocity;
  for (int pass = 0; pass < kMidpointPasses; ++pass)
    spin = angularVelocity(inertia, rotationBy((0.5 * dt_s) * spin) * R_WB, momentum);
  return spin;
}

}  // namespace carom
