#pragma once
// The rotation of a rigid body on which no torque acts, in closed form: Jacobi's solution of Euler's
// equations (Jacobi 1850; Landau and Lifshitz 1976, section 37). The angular momentum, seen from the body,
// goes round on a curve of Jacobi's elliptic functions; the body turns about it by an angle whose periodic
// part is the argument of a theta function. Any time is as exact and as dear as any other. Tested in
// tests/engine/motion/free_rotation_test.cpp.

#include <array>
#include <cstddef>

#include "engine/foundation/frames.h"
#include "engine/motion/rigid_body.h"

namespace carom {

/// Radians: a rotation by more than this has no reliable axis, as near a whole turn it looks like none.
inline constexpr double kLargestTurn = 2.0;

class FreeRotation {
 public:
  FreeRotation() = default;
  /// Of a body in this orientation that turns at an angular velocity other than zero, world frame. The
  /// inertia must stay where it is.
  FreeRotation(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity);

  /// Nothing is known of a rotation.
  bool empty() const { return inertia_ == nullptr; }
  /// The orientation `dt_s` seconds later, or earlier; of unit length but for rounding.
  Quat after(double dt_s) const;
  /// The constant spin, world frame, that carries the body from where it starts, `R_WB`, to where it is
  /// `dt_s` seconds later. Beyond two radians the spin of the first two.
  Vec3 meanSpin(const Quat& R_WB, double dt_s) const;
  /// When the body has an orientation.
  Vec3 angularVelocityIn(const Quat& R_WB) const { return angularVelocity(*inertia_, R_WB, momentum_); }
  const Vec3& angularMomentum() const { return momentum_; }
  /// A bound at all times, rad/s, from the energy.
  double fastestSpin() const { return fastest_spin_; }

 private:
  // Theta functions are summed in the nome q or, where that is above e^-pi, in the complementary one: their
  // terms fall with q^(n^2), so that four are exact to rounding.
  static constexpr std::size_t kTerms = 4;
  using Terms = std::array<double, kTerms>;
  struct Thetas {
    // The second, first and third theta function, which cn, sn and dn are made of.
    double x = 0.0, y = 0.0, z = 1.0;
    double real = 0.0, imaginary = 0.0;  // the first one at a complex argument
  };
  Thetas thetas(double phase) const;
  Thetas thetasNearSeparatrix(double phase) const;
  Quat towardsMomentum(double dt_s) const;

  const Inertia* inertia_ = nullptr;
  Vec3 momentum_ = Vec3::Zero();  // angular, kg m^2/s, world frame
  double fastest_spin_ = 0.0;
  bool near_separatrix_ = false;
  double turning_ = 0.0;      // rad/s about the momentum, without the periodic part
  double phase_rate_ = 0.0;   // 1/s
  double phase_ = 0.0;        // at the start
  double half_period_ = 1.0;  // of the phase: then the momentum is at the other side of the axis
  double skew_ = 0.0;         // rad of the periodic part for each unit of the phase within a half period
  double lean_ = 0.0;         // the momentum's way along x to that along y, times theta functions
  double side_ = 0.0;         // the momentum's way along y, likewise
  double up_ = 0.0;           // the momentum's component along z, likewise
  double root_ = 0.0;         // the fourth root of the nome
  Terms square_ = {};         // the nome to the n^2
  Terms between_ = {};        // the nome to the n (n + 1)
  Terms real_ = {};           // of the coefficients of the theta function at a complex argument
  Terms imaginary_ = {};
  Quat R_WL_ = Quat::Identity();  // L: a frame whose z axis is the momentum
  Quat R_SB_ = Quat::Identity();  // S: the principal axes in the order of the solution
};

/// Where torque-free rotation takes the orientation of a body, which may be at rest, in `dt_s` seconds,
/// however far it turns.
Quat torqueFreeRotation(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s);
/// The mean spin of a body, which may be at rest, over the next `dt_s` seconds of torque-free rotation. With
/// omega recomputed from the conserved angular momentum at the end, momentum and energy are exact.
Vec3 torqueFreeSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s);
/// By how many radians, at most, constant spin misses the torque-free orientation on its way through `dt_s`:
/// |d omega / dt| dt^2 / 8.
double tumblingMiss(const Inertia& inertia, const Quat& R_WB, const Vec3& angular_velocity, double dt_s);

}  // namespace carom
