#include "engine/motion/rigid_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr int kNearestSteps = 30;  // of Newton, for the momentum nearest to one: four or five are made
constexpr double kSameEnergy = 1e-15;
constexpr double kMostGrowth = -0.5;  // the momentum about the axis of the least moment doubles at most

}  // namespace

Inertia inertiaOf(double density_kgpm3, double volume, const Mat3& unit_inertia) {
  Inertia inertia;
  inertia.mass_kg = density_kgpm3 * volume;
  inertia.inverse_mass = 1.0 / inertia.mass_kg;
  inertia.tensor_B = density_kgpm3 * unit_inertia;
  inertia.inverse_tensor_B = inertia.tensor_B.inverse();
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(inertia.tensor_B);
  inertia.principal_axes_B = principal.eigenvectors();
  inertia.principal_moments = principal.eigenvalues();
  if (inertia.principal_axes_B.determinant() < 0.0) inertia.principal_axes_B.col(0) *= -1.0;
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
         0.5 * dot(velocity.angular, angularMomentum(inertia, R_WB, velocity.angular));
}

Vec3 spinOfEnergy(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_momentum, double energy_J) {
  // Lagrange: L_i / (1 + s I_min / I_i) along each principal axis. The energy falls with s; its inverse root
  // is nearly linear in s, so Newton's steps on that converge from everywhere.
  const Mat3 R_WP = R_WB.toRotationMatrix() * inertia.principal_axes_B;
  const Vec3& moments = inertia.principal_moments;
  const Vec3 momentum = R_WP.transpose() * angular_momentum;
  const Vec3 share = moments[0] * moments.cwiseInverse();
  double s = 0.0;
  double energy = 0.0;
  Vec3 nearest = momentum;
  for (int i = 0; i <= kNearestSteps; ++i) {
    const Vec3 shrinking = Vec3::Ones() + s * share;
    nearest = momentum.cwiseQuotient(shrinking);
    const Vec3 energies = 0.5 * nearest.cwiseProduct(nearest).cwiseQuotient(moments);
    energy = energies.sum();
    if (!(energy > 0.0) || std::abs(energy - energy_J) <= kSameEnergy * energy_J || i == kNearestSteps) break;
    const double slope = energies.cwiseProduct(share).cwiseQuotient(shrinking).sum();  // -1/2 d energy / ds
    s = std::max(kMostGrowth, s + (std::sqrt(energy / energy_J) - 1.0) * energy / slope);
  }
  const Vec3 spin = R_WP * nearest.cwiseQuotient(moments);
  return energy > energy_J ? Vec3(spin * std::sqrt(energy_J / energy)) : spin;
}

}  // namespace carom
