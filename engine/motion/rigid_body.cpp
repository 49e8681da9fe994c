#include "engine/motion/rigid_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "engine/foundation/elementary.h"

namespace carom {
namespace {

// A rotation by more than this has no reliable axis: near a whole turn it looks like none.
constexpr double kLargestTurn = 2.0;

// Turns the body about one of its principal axes by the flow of the energy L_i^2 / 2 (1/I_i - 1/I_reference):
// the angular momentum in the body turns the other way.
template <int kAxis>
void turnAboutAxis(double rate_per_momentum, double dt_s, Quat& R, Vec3& momentum_P) {
  constexpr int kNext = (kAxis + 1) % 3, kLast = (kAxis + 2) % 3;
  const SineCosine half = sineCosine(0.5 * rate_per_momentum * momentum_P[kAxis] * dt_s);
  const double s = half.sine, c = half.cosine;
  const Vec3 v = R.vec();
  const double w = R.w();
  R.w() = w * c - v[kAxis] * s;
  R.vec()[kAxis] = v[kAxis] * c + w * s;
  R.vec()[kNext] = v[kNext] * c + v[kLast] * s;
  R.vec()[kLast] = v[kLast] * c - v[kNext] * s;
  const double cosine = 1.0 - 2.0 * s * s, sine = 2.0 * s * c;
  const double next = momentum_P[kNext], last = momentum_P[kLast];
  momentum_P[kNext] = cosine * next + sine * last;
  momentum_P[kLast] = cosine * last - sine * next;
}

// A second-order step forwards, back and forwards makes a fourth-order one (Yoshida 1990): 1 / (2 - 2^(1/3)).
constexpr double kOuterShare = 1.3512071919596578;
constexpr double kFourthOrder[] = {kOuterShare, 1.0 - 2.0 * kOuterShare, kOuterShare};
constexpr double kPartTurn = 0.1;     // rad in one such step
constexpr double kTumbleTurn = 0.01;  // the same where the energy of single impacts hangs on it
constexpr int kNearestSteps = 30;     // of Newton, for the momentum nearest to one: four or five are made
constexpr double kSameEnergy = 1e-15;
constexpr double kMostGrowth = -0.5;  // the momentum about the axis of the least moment doubles at most
constexpr double kMostParts = 256.0;  // beyond some ten radians a step the energy becomes less exact

// Torque-free rotation in equal steps. 1/I = 1/I_middle + (the rest): the first turns the body about the
// momentum, whatever the others do.
Quat rotatedFreely(const Inertia& inertia, const Quat& R_WB, const Vec3& momentum, double dt_s, int parts) {
  const Vec3& moments = inertia.principal_moments;
  const double low_rate = 1.0 / moments[0] - 1.0 / moments[1];
  const double high_rate = 1.0 / moments[2] - 1.0 / moments[1];
  Quat R = R_WB * Quat(inertia.principal_axes_B);
  Vec3 momentum_P = R.conjugate() * momentum;
  if (low_rate != 0.0 || high_rate != 0.0) {
    // Turns about one axis that follow each other are one.
    double waiting = 0.0;
    for (int i = 0; i < parts; ++i) {
      for (double share : kFourthOrder) {
        const double h = share * dt_s / parts;
        turnAboutAxis<2>(high_rate, waiting + 0.5 * h, R, momentum_P);
        turnAboutAxis<0>(low_rate, h, R, momentum_P);
        waiting = 0.5 * h;
      }
    }
    turnAboutAxis<2>(high_rate, waiting, R, momentum_P);
  }
  return rotationBy((dt_s / moments[1]) * momentum) * R * Quat(inertia.principal_axes_B).conjugate();
}

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
         0.5 * velocity.angular.dot(angularMomentum(inertia, R_WB, velocity.angular));
}

Tumbling tumbling(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double longest_s) {
  const Vec3 momentum = angularMomentum(inertia, R_WB, angular_velocity);
  // I_smallest omega^2 <= omega . I omega, at all times.
  const double fastest = std::sqrt(angular_velocity.dot(momentum) / inertia.principal_moments[0]);
  // The two rotations of the splitting; with one of them alone, about an axis of symmetry, it is exact.
  const Vec3& moments = inertia.principal_moments;
  const double low_turn = (1.0 / moments[0] - 1.0 / moments[1]) * momentum.norm() * longest_s;
  const double high_turn = (1.0 / moments[1] - 1.0 / moments[2]) * momentum.norm() * longest_s;
  const double parts = std::sqrt(std::max(0.0, low_turn * high_turn)) / kTumbleTurn;
  return {&inertia, momentum, fastest, 1 + static_cast<int>(std::min(parts, kMostParts))};
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

Quat rotationAfter(const Tumbling& tumbling, const Quat& R_WB, double dt_s) {
  return rotatedFreely(*tumbling.inertia, R_WB, tumbling.momentum, dt_s, tumbling.parts);
}

double tumblingMiss(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  const Vec3 torque = angularMomentum(inertia, R_WB, angular_velocity).cross(angular_velocity);
  return angularVelocity(inertia, R_WB, torque).norm() * dt_s * dt_s / 8.0;
}

Vec3 torqueFreeSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s) {
  const double speed = angular_velocity.norm();
  if (speed == 0.0) return angular_velocity;
  const double dt = std::min(dt_s, kLargestTurn / speed);
  const Vec3 momentum = angularMomentum(inertia, R_WB, angular_velocity);
  const int parts = static_cast<int>(std::ceil(speed * std::abs(dt) / kPartTurn));
  return rotationOf(rotatedFreely(inertia, R_WB, momentum, dt, parts) * R_WB.conjugate()) / dt;
}

}  // namespace carom
