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

Vec3 spinOfEnergy(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_momentum, double energy_J,
                  const Vec3& kept_W) {
  // Lagrange: (L_i + c u_i) / (1 + s I_min / I_i) along each principal axis, with c so that the part along u
  // stays. The energy falls with s; its inverse root is nearly linear in s, so Newton's steps on that
  // converge from everywhere.
  const Mat3 R_WP = R_WB.toRotationMatrix() * inertia.principal_axes_B;
  const Vec3& moments = inertia.principal_moments;
  const Vec3 momentum = R_WP.transpose() * angular_momentum;
  const Vec3 share = moments[0] * moments.cwiseInverse();
  Vec3 u = Vec3::Zero();
  if (!kept_W.isZero(0.0)) u = R_WP.transpose() * kept_W.normalized();
  const double kept = dot(u, momentum);
  // The least energy with that part is the one of spinning about u alone.
  if (kept * kept >= 2.0 * energy_J * dot(u, moments.cwiseProduct(u))) u.setZero();
  const bool keeps = !u.isZero(0.0);
  double s = 0.0;
  double energy = 0.0;
  Vec3 nearest = momentum;
  for (int i = 0; i <= kNearestSteps; ++i) {
    const Vec3 shrunk = (Vec3::Ones() + s * share).cwiseInverse();
    const Vec3 along = shrunk.cwiseProduct(u);
    nearest = momentum.cwiseProduct(shrunk);
    if (keeps) nearest += (kept - dot(u, nearest)) / dot(u, along) * along;
    energy = 0.5 * dot(nearest.cwiseProduct(nearest), moments.cwiseInverse());
    if (!(energy > 0.0) || std::abs(energy - energy_J) <= kSameEnergy * energy_J || i == kNearestSteps) break;
    const Vec3 weighed = share.cwiseProduct(nearest);
    double slope = dot(weighed.cwiseProduct(weighed), shrunk);  // -I_min d energy / ds
    if (keeps) slope -= dot(along, weighed) * dot(along, weighed) / dot(u, along);
    if (!(slope > 0.0)) break;
    s = std::max(kMostGrowth, s + (std::sqrt(energy / energy_J) - 1.0) * energy * 2.0 * moments[0] / slope);
  }
  const Vec3 spin = R_WP * nearest.cwiseQuotient(moments);
  return energy > energy_J ? Vec3(spin * std::sqrt(energy_J / energy)) : spin;
}

}  // namespace carom
