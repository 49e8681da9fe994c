#pragma once
// The impulse of one contact point (paper §2.1, after Baraff): how bodies answer to an impulse at a point,
// and the frictionless j of the paper's formula. DEVIATES: -(1 + e) for the printed -(1 - e). DEVIATES: n .
// [(J^-1 (r x n)) x r] with the world-frame tensor for the printed (r x n)^2 / J. Tested in
// tests/engine/response/one_point/impulse_test.cpp.

#include "engine/motion/rigid_body.h"

namespace carom {

/// A body as impulses see it, world frame. A body that cannot move has zero inverses.
struct ImpulseBody {
  Velocity velocity;
  Vec3 center = Vec3::Zero();
  double inverse_mass = 0.0;
  Mat3 inverse_tensor = Mat3::Zero();
  // Of the contact solver:
  double stir = 0.0;       ///< The sum of the speeds, m/s, that its rows have changed.
  bool is_listed = false;  ///< While it lists the bodies of its rows.
  /// 1 along the world's axes that it can move along, 0 along those that are locked. Locked turning is in
  /// the tensor.
  Vec3 free_axes = Vec3::Ones();
  bool has_locks = false;  ///< Of either.

  /// The speed along n that a unit impulse along n gives the centre.
  double inverseMassAlong(const Vec3& n) const {
    if (!has_locks) return inverse_mass;
    return inverse_mass * free_axes.cwiseProduct(n).squaredNorm();
  }

  /// Changes the velocity by an impulse (N s) at arm r from the centre of mass.
  void apply(const Vec3& impulse, const Vec3& r) {
    velocity.linear += inverse_mass * free_axes.cwiseProduct(impulse);
    turn(r.cross(impulse));
  }
  /// The same by a torque impulse (N m s).
  void turn(const Vec3& torque) { velocity.angular += inverse_tensor * torque; }
};

/// K, 1/kg: the change of the relative velocity at a point is K times the impulse on B (and its opposite on
/// A). Of bodies with locked axes K may answer nothing in some directions; it then has a trace of an answer
/// there, below the rounding of what it answers elsewhere, so that it has an inverse.
Mat3 collisionMatrix(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b);

/// Whether locked axes leave so little of a response, 1/kg, along some direction that no impulse changes the
/// relative velocity of the two.
bool isUnanswered(const ImpulseBody& a, const ImpulseBody& b, double response);

/// The paper's j, N s along n (A to B): brings the separating speed u to -e u. Zero when u >= 0.
double frictionlessImpulse(const ImpulseBody& a, const ImpulseBody& b, const Vec3& r_a, const Vec3& r_b,
                           const Vec3& n, double restitution);

}  // namespace carom
