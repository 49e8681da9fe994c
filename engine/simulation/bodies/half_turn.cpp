#include "engine/simulation/bodies/half_turn.h"

#include "engine/foundation/elementary.h"
#include "engine/motion/free_rotation.h"

namespace carom {
namespace {

// Where a constant angular momentum takes an orientation.
Quat turned(const Inertia& inertia, const Quat& R_WB, const Vec3& momentum, double dt_s) {
  const Vec3 spin = angularVelocity(inertia, R_WB, momentum);
  return rotationBy(dt_s * torqueFreeSpin(inertia, R_WB, spin, dt_s)) * R_WB;
}

}  // namespace

HalfTurn halfTurn(const Body& body, double step_s, double noticed_mps) {
  HalfTurn half{body.X_WB.rotation, body.velocity.angular};
  const Vec3& spin = body.velocity.angular;
  if (!body.moves() || spin.isZero(0.0) || spin.norm() * step_s > kLargestTurn) return half;
  const double half_step_s = 0.5 * step_s;
  const Vec3 momentum = angularMomentum(body.inertia, half.R_WB, spin);
  const Vec3 gained = half_step_s * angularVelocity(body.inertia, half.R_WB, momentum.cross(spin));
  if (!(gained.norm() * body.radius_m > noticed_mps)) return half;
  const Vec3 torque = body.torque + body.contact_torque;
  half.R_WB =
      turned(body.inertia, half.R_WB, momentum + 0.5 * half_step_s * torque, half_step_s).normalized();
  half.spin = spinOfEnergy(body.inertia, half.R_WB, momentum, 0.5 * dot(spin, momentum), body.pull.steady);
  half.tumbles = true;
  return half;
}

Vec3 meanSpin(const Body& body, const HalfTurn& half, const Vec3& spin_after, double step_s) {
  if (!half.tumbles) return 0.5 * (body.velocity.angular + spin_after);
  const double half_step_s = 0.5 * step_s;
  const Quat& R_begin = body.X_WB.rotation;
  const Vec3 momentum = angularMomentum(body.inertia, R_begin, body.velocity.angular);
  const Vec3 gained = angularMomentum(body.inertia, half.R_WB, spin_after - half.spin);
  const Quat R_middle = turned(body.inertia, R_begin, momentum + 0.25 * gained, half_step_s);
  const Quat R_end = turned(body.inertia, R_middle, momentum + 0.75 * gained, half_step_s);
  return rotationOf(R_end * R_begin.conjugate()) / step_s;
}

}  // namespace carom
