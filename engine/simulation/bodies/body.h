#pragma once
// What the world keeps of a body and of its parts. Internal to the simulation floor.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "engine/modes/resting.h"
#include "engine/modes/swinging.h"
#include "engine/motion/axis_locks.h"
#include "engine/motion/rigid_body.h"
#include "engine/motion/trajectory.h"
#include "engine/response/one_point/impulse.h"
#include "engine/simulation/bodies/pull.h"
#include "engine/simulation/bodies/world_types.h"
#include "engine/solid/solid.h"

namespace carom {

/// How a body travels through the current step.
enum class Travel : std::uint8_t {
  kStill,      ///< Static or resting.
  kBallistic,  ///< Free flight: gravity and what else surrounds the body act along the path.
  kCarried,    ///< In lasting contact, whose forces act evenly over the step (paper §2.4).
  kDriven,     ///< A kinematic body on its prescribed path.
  kHeld        ///< Stopped at its last safe time for the rest of the step.
};

/// How a body moves from an instant of the step on. The path is where it goes; the momentum velocity is what
/// impulses act on. They differ in lasting contact, where the path also reopens gaps without giving the body
/// energy. Forces act evenly in time, so that a body struck within the step has what they have given it until
/// then.
struct StepMotion {
  Travel travel = Travel::kStill;
  Trajectory path;
  Velocity momentum_velocity;        ///< At path.start_s.
  Vec3 acceleration = Vec3::Zero();  ///< Of the momentum velocity: by the environment, and lasting contacts.
  Vec3 torque = Vec3::Zero();        ///< Theirs, N m, world frame.
  /// Where gravity and its load pull it. Forces along this do not change the angular momentum about it.
  Vec3 pull_W = Vec3::Zero();
  /// W, of a body that tumbles through air or fluids: what all that makes of its energy of turning. Near the
  /// orientation of its flight, which its path leads it to, a slender body with the same angular momentum has
  /// another energy.
  std::optional<double> turning_power;
  // The same of its rotation, in its own frame when it had the orientation that its forces were found for:
  // the angular velocity at path.start_s, rad/s, and what they make of it, rad/s^2.
  Vec3 solved_spin_B = Vec3::Zero();
  Vec3 turning_B = Vec3::Zero();
  double lift = 0.0;  ///< Of the substep's paths until path.start_s, J/kg (liftOfPath).
  /// The integral of its place over those paths, from where the substep began, m s.
  Vec3 place_sum = Vec3::Zero();
  double load_work_J = 0.0;  ///< What its load has done on them.
  double opening_W = 0.0;  ///< What contacts do on its path since then, where that opens them (openingPower).

  /// The velocity impulses act on, at a time not before path.start_s at which the path has turned the body to
  /// `R_WB`. In flight the path is the body's own rotation, and its angular momentum says how it turns. Where
  /// contacts lead the path, the body has the energy that their impulses left it, whatever its orientation,
  /// and keeps its angular momentum about its pull.
  Velocity velocityAt(const Inertia& inertia, double t_s, const Quat& R_WB) const {
    Velocity v = momentum_velocity;
    const double dt = t_s - path.start_s;
    if (travel == Travel::kStill || dt == 0.0) return v;
    v.linear += dt * acceleration;
    if (travel == Travel::kDriven) {
      v.angular += dt * path.spin_change.rate;
      return v;
    }
    if (v.angular.isZero(0.0) && torque.isZero(0.0)) return v;
    const Vec3 before = angularMomentum(inertia, path.X_WB.rotation, v.angular);
    const Vec3 momentum = before + dt * torque;
    if (travel == Travel::kBallistic) {
      v.angular = turning_power ? tumblingSpin(inertia, R_WB, v.angular, before, dt)
                                : angularVelocity(inertia, R_WB, momentum);
      return v;
    }
    const Vec3 spin_B = solved_spin_B + dt * turning_B;
    v.angular = spinOfEnergy(inertia, R_WB, momentum, 0.5 * dot(spin_B, inertia.tensor_B * spin_B), pull_W);
    return v;
  }

  /// What the forces of `dt_s` seconds make of its spin, seen in the orientation R_WB.
  Vec3 spinGained(const Inertia& inertia, const Quat& R_WB, const Vec3& spin, double dt_s) const {
    if (torque.isZero(0.0)) return Vec3::Zero();
    if (travel != Travel::kBallistic || !turning_power) return angularVelocity(inertia, R_WB, dt_s * torque);
    return tumblingSpin(inertia, R_WB, spin, angularMomentum(inertia, R_WB, spin), dt_s) - spin;
  }

 private:
  // What torque and power make in `dt_s` of a spin and its angular momentum, in the orientation R_WB.
  Vec3 tumblingSpin(const Inertia& inertia, const Quat& R_WB, const Vec3& spin, const Vec3& momentum,
                    double dt_s) const {
    const double energy = std::max(0.0, 0.5 * dot(spin, momentum) + dt_s * *turning_power);
    return spinOfEnergy(inertia, R_WB, momentum + dt_s * torque, energy);
  }
};

struct Body : StepMotion {
  Inertia inertia;
  Material material;
  double radius_m = 0.0;
  Pull pull;
  bool is_static = false;
  bool is_kinematic = false;  ///< Its path is prescribed: nothing that it meets changes it.
  double late_s = 0.0;        ///< How late it is on that path: for so long things in its way have stopped it.
  bool was_stopped = false;   ///< In the last step, and its way has not been found free since.
  double piece_end_s = std::numeric_limits<double>::infinity();  ///< Of the path, within the step.
  AxisLocks locks;
  bool resting = false;
  int next_at_rest = -1;   ///< Those that came to rest together are a ring.
  bool active = true;      ///< In the list of active bodies (active_bodies.h).
  bool lay = false;        ///< It did not move when the last step began.
  bool supported = false;  ///< Static, resting, or pressed by lasting contact in the last step.
  // What lasting contacts gave it in the last step, in the mean: its way through water and air is foreseen
  // with this, or what a floor holds would seem to sink. Zero in flight.
  Vec3 contact_force = Vec3::Zero();   ///< N, world frame.
  Vec3 contact_torque = Vec3::Zero();  ///< N m about the centre of mass, world frame.
  double still_s = 0.0;                ///< For how long it has lain still.
  SwingWatch swing;                    ///< Whether it swings about its rest.
  Mode mode = Mode::kFree;

  Pose X_WB;          ///< At the time of the last finished step.
  Velocity velocity;  ///< At the time of the last finished step.
  /// kg m^2/s, world frame, of a body that has flown freely since it was computed: not rounded in every step.
  std::optional<Vec3> kept_angular_momentum;

  // Within a step, besides its motion.
  Pose X_end;  ///< Where its path ends, at the end of the step.
  int events = 0;
  int cleared = 0;  ///< How often its path was led clear of another body.
  bool collided = false;
  bool frozen = false;  ///< In some substep of this step: it is counted once.

  /// Whether impulses can move it.
  bool yields() const { return !is_static && !is_kinematic; }
  bool moves() const { return yields() && !resting; }
  /// Whether it has a path through the step.
  bool travels() const { return moves() || is_kinematic; }
  /// What lies on it cannot come to rest.
  bool isDriven() const { return is_kinematic && !path.still(); }
  bool liesStill() const { return !moves() || carom::liesStill(velocity, radius_m); }
  /// Nothing has turned it in this step but its own spin.
  bool flewFreely() const {
    return travel == Travel::kBallistic && path.start_s == 0.0 && torque.isZero(0.0) &&
           momentum_velocity.angular == velocity.angular;
  }

  /// The velocity impulses act on, at a time not before path.start_s.
  Velocity velocityAt(double t_s) const { return velocityAt(t_s, path.at(t_s).rotation); }
  /// The same when it is known that the path has turned the body to `R_WB`.
  Velocity velocityAt(double t_s, const Quat& R_WB) const {
    return StepMotion::velocityAt(inertia, t_s, R_WB);
  }

  ImpulseBody impulseBody(const Pose& X, const Velocity& v) const {
    ImpulseBody seen{v, X.position, inertia.inverse_mass,
                     yields() ? inverseTensorInWorld(inertia, X.rotation) : Mat3(Mat3::Zero())};
    if (yields() && locks.any()) {
      seen.free_axes = locks.free_axes;
      seen.has_locks = true;
      if (locks.turning != AxisLocks::Turning::kFree) seen.inverse_tensor = turningResponse(inertia, locks);
    }
    return seen;
  }
};

/// The body stays where its path has come to.
inline void endPath(Body& body) {
  body.travel = Travel::kHeld;
  body.path.velocity.setZero();
  body.path.acceleration.setZero();
  body.path.turnAt(Vec3::Zero());
  body.opening_W = 0.0;
}

/// Stops a kinematic body for the rest of the step.
inline void stopKinematic(Body& body) {
  endPath(body);
  body.momentum_velocity = {};
  body.acceleration.setZero();
}

/// Makes a body that rested move again.
inline void wake(Body& body) {
  body.resting = body.lay = false;
  body.still_s = 0.0;
}

/// Where constant spin misses the orientation of a free body by more radians than this, its path is its free
/// rotation: impacts on the way find the body as it is.
inline constexpr double kTumblingMiss = 1e-9;

/// Lets the body's path, which starts with its momentum velocity, turn torque-free for `dt_s` seconds.
inline void turnFreely(Body& body, double dt_s) {
  const Quat& R = body.path.X_WB.rotation;
  const Vec3& omega = body.momentum_velocity.angular;
  if (omega.isZero(0.0) || dt_s == 0.0 || body.inertia.isIsotropic()) return body.path.turnAt(omega);
  const FreeRotation free(body.inertia, R, omega);
  body.path.turnAt(free.meanSpin(R, dt_s));
  if (tumblingMiss(body.inertia, R, omega, dt_s) > kTumblingMiss) body.path.tumbling = free;
}

/// So many bodies are worked on by one thread: to wait for another takes as long.
inline constexpr std::size_t kFewBodies = 500;

/// One convex part of one body: what the broad phase pairs. The shapes of a world ascend by body.
struct Shape {
  int body = -1;
  const ConvexPart* part = nullptr;
  double reach_m = 0.0;  ///< The largest distance of the core from the body's centre of mass.
  double width_m = 0.0;  ///< Of the body, as the collision window takes it: +infinity where it cannot move.
};

}  // namespace carom
