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
void turnAboutAxis(int axis, double rate_per_momentum, double dt_s, Quat& R, Vec3& momentum_P) {
  Vec3 turn = Vec3::Zero();
  turn[axis] = rate_per_momentum * momentum_P[axis] * dt_s;
  const Quat q = rotationBy(turn);
  R = R * q;
  momentum_P = q.conjugate() * momentum_P;
}

// A second-order step forwards, back and forwards makes a fourth-order one (Yoshida 1990): 1 / (2 - 2^(1/3)).
constexpr double kOuterShare = 1.3512071919596578;
constexpr double kFourthOrder[] = {kOuterShare, 1.0 - 2.0 * kOuterShare, kOuterShare};
constexpr double kPartTurn = 0.1;     // rad in one such step
constexpr double kTumbleTurn = 0.01;  // the same where the energy of single impacts hangs on it
constexpr double kNoTurn =
    0x1p-26;  // rad in all: it changes an angular velocity by less than that share of it
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
    for (int i = 0; i < parts; ++i) {
      for (double share : kFourthOrder) {
        const double h = share * dt_s / parts;
        turnAboutAxis(2, high_rate, 0.5 * h, R, momentum_P);
        turnAboutAxis(0, low_rate, h, R, momentum_P);
        turnAboutAxis(2, high_rate, 0.5 * h, R, momentum_P);
      }
    }
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

Vec3 torqueFreeSpinInBody(const Inertia& inertia, const Vec3& spin_B, double dt_s) {
  if (spin_B.norm() * std::abs(dt_s) < kNoTurn) return spin_B;
  const Tumbling free = tumbling(inertia, Quat::Identity(), spin_B, dt_s);
  const Vec3 momentum = rotationAfter(free, Quat::Identity(), dt_s).conjugate() * free.momentum;
  const Vec3 spin = inertia.inverse_tensor_B * momentum;
  return spin * std::sqrt(spin_B.dot(free.momentum) / spin.dot(momentum));
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
