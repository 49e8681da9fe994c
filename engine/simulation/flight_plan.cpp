#include "engine/simulation/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "engine/environment/gravity.h"

namespace carom {
namespace {

// Where drag takes most of a velocity within a step the mean force would carry a body there and back again;
// its path is then as straight as keeps it from turning round. Times gravity: what counts as such drag.
constexpr double kBraking = 4.0;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Only its room is kept.
ForceScratch& scratch() {
  static thread_local ForceScratch scratch;
  return scratch;
}

}  // namespace

FlightPlanner::FlightPlanner(const WorldSettings& settings)
    : environment_{settings.gravity, settings.air, settings.fluids}, step_s_(settings.step_s) {}

void FlightPlanner::begin(std::span<const Solid> solids, std::vector<int> solid_of) {
  solid_of_ = std::move(solid_of);
  surfaces_.clear();
  if (isVacuum()) return;
  for (const Solid& solid : solids) surfaces_.push_back(surfaceOf(solid));
}

EnvironmentBody FlightPlanner::environmentBody(int index, const Body& body) const {
  return {&surfaces_[at(solid_of_[at(index)])], &body.inertia, body.material.drag_coefficient};
}

// Whether more than gravity acts on the body on its way.
bool FlightPlanner::isTouched(const Body& body, double rest_of_step_s) const {
  if (environment_.air.density_kgpm3 > 0.0) return true;
  const double way =
      (body.momentum_velocity.linear.norm() + 0.5 * rest_of_step_s * environment_.gravity.norm()) *
      rest_of_step_s;
  return std::any_of(environment_.fluids.begin(), environment_.fluids.end(), [&](const Fluid& fluid) {
    return reaches(fluid, body.path.X_WB.position, body.radius_m + way);
  });
}

void FlightPlanner::plan(int index, Body& body) const {
  planPath(index, body);
  const Quat to_body = body.path.X_WB.rotation.conjugate();
  body.solved_spin_B = to_body * body.momentum_velocity.angular;
  body.turning_B = body.inertia.inverse_tensor_B * (to_body * body.torque);
}

void FlightPlanner::planPath(int index, Body& body) const {
  Trajectory& path = body.path;
  const double dt = step_s_ - path.start_s;
  const Velocity& start = body.momentum_velocity;
  path.velocity = start.linear;
  path.acceleration = environment_.gravity;
  body.acceleration = environment_.gravity;
  body.torque.setZero();
  if (!(dt > 0.0) || isVacuum() || !isTouched(body, dt)) {
    turnFreely(body, dt);
    return;
  }
  const EnvironmentFlight flight =
      flyThroughEnvironment(environment_, environmentBody(index, body), path.X_WB, start,
                            {body.contact_force, body.contact_torque}, time_s_ + path.start_s, dt, scratch());
  const Vec3 mean = (flight.X_end.position - path.X_WB.position) / dt;
  const Vec3 momentum = angularMomentum(body.inertia, path.X_WB.rotation, start.angular);
  path.acceleration = (flight.velocity_end - start.linear) / dt;
  body.acceleration = path.acceleration - body.inertia.inverse_mass * body.contact_force;
  body.torque = (flight.angular_momentum_end - momentum) / dt - body.contact_torque;
  const double swing = 0.5 * dt * path.acceleration.norm();
  if (path.acceleration.norm() > kBraking * environment_.gravity.norm() && swing > mean.norm())
    path.acceleration *= mean.norm() / swing;
  path.velocity = mean - (0.5 * dt) * path.acceleration;
  path.turnAt(flight.spin);
}

void FlightPlanner::planStep(int index, Body& body) const {
  body.travel = Travel::kBallistic;
  body.path = Trajectory{0.0, body.X_WB, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  body.momentum_velocity = body.velocity;
  plan(index, body);
}

void FlightPlanner::takeContacts(Body& body, const Velocity& change, const Quat& R_WB) const {
  body.contact_force = body.inertia.mass_kg / step_s_ * change.linear;
  body.contact_torque = angularMomentum(body.inertia, R_WB, change.angular) / step_s_;
}

void FlightPlanner::leaveContacts(int index, Body& body) const {
  if (body.contact_force.isZero(0.0) && body.contact_torque.isZero(0.0)) return;
  body.contact_force.setZero();
  body.contact_torque.setZero();
  plan(index, body);
}

Velocity FlightPlanner::gained(const Body& body) const {
  const double dt = step_s_ - body.path.start_s;
  Velocity gain{gravityImpulsePerMass(body.acceleration, dt), Vec3::Zero()};
  if (!body.torque.isZero(0.0))
    gain.angular = inverseTensorInWorld(body.inertia, body.path.X_WB.rotation) * (dt * body.torque);
  return gain;
}

Velocity FlightPlanner::pushAtRest(int index, const Body& body) const {
  const BodyForces forces = bodyForces(environment_, environmentBody(index, body), body.X_WB, Vec6::Zero(),
                                       time_s_ + step_s_, scratch());
  const Vec6 wrench = forces.total(Vec6::Zero());
  const Quat& R_WB = body.X_WB.rotation;
  return {step_s_ * body.inertia.inverse_mass * (R_WB * wrench.head<3>()),
          step_s_ * (R_WB * (body.inertia.inverse_tensor_B * wrench.tail<3>()))};
}

bool FlightPlanner::restless(const Body& body) const {
  return std::any_of(environment_.fluids.begin(), environment_.fluids.end(), [&](const Fluid& fluid) {
    return !fluid.waves.empty() && reaches(fluid, body.X_WB.position, body.radius_m);
  });
}

double FlightPlanner::potential(int index, const Body& body) const {
  double energy = gravityPotential(body.inertia, environment_.gravity, body.X_WB.position);
  if (surfaces_.empty()) return energy;  // vacuum, or a world not started
  return energy +
         buoyancyPotential(environment_, surfaces_[at(solid_of_[at(index)])], body.X_WB, time_s_, scratch());
}

}  // namespace carom
