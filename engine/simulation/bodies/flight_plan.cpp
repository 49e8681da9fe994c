#include "engine/simulation/bodies/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "engine/environment/gravity.h"
#include "engine/foundation/index.h"

namespace carom {
namespace {

// Where drag takes most of a velocity within a step the mean force would carry a body there and back again;
// its path is then as straight as keeps it from turning round. Times gravity: what counts as such drag.
constexpr double kBraking = 4.0;
constexpr double kSameTime = 1e-9;  // of a step: a piece of a path that ends so soon is over

// The integral of the angular velocity over the path, rad. A path that tumbles has the mean of the step's
// angular momenta: half of what is given to them is given at its start and half at its end, and gives the
// mean of the spins before and after.
Vec3 turnedBy(const Body& body, double step_s, double end_s) {
  const Trajectory& path = body.path;
  const double dt = end_s - path.start_s;
  if (body.travel != Travel::kBallistic) return dt * path.spin;
  const Vec3 momentum = angularMomentum(body.inertia, path.X_WB.rotation, body.momentum_velocity.angular);
  const auto spinAt = [&](double t_s, const Vec3& L) {
    return angularVelocity(body.inertia, path.at(t_s).rotation, L);
  };
  if (path.tumbling.empty()) return dt * spinAt(path.start_s + 0.5 * dt, momentum + (0.5 * dt) * body.torque);
  const Vec3& on_path = path.tumbling.angularMomentum();
  const double half_s = 0.5 * (step_s - path.start_s);
  return (0.5 * half_s) * (body.momentum_velocity.angular + spinAt(path.start_s, on_path)) +
         (0.5 * (dt - half_s)) * (spinAt(end_s, on_path) + spinAt(end_s, momentum + dt * body.torque));
}

}  // namespace

FlightPlanner::FlightPlanner(const WorldSettings& settings)
    : environment_{settings.gravity, settings.air, settings.fluids}, step_s_(settings.step_s) {}

void FlightPlanner::begin(std::span<const Solid> solids, std::vector<int> solid_of) {
  solid_of_ = std::move(solid_of);
  surfaces_.clear();
  if (isVacuum() &&
      std::none_of(loads_.begin(), loads_.end(), [](const AppliedLoad& load) { return load.bends(); }))
    return;
  for (const Solid& solid : solids) surfaces_.push_back(surfaceOf(solid));
}

void FlightPlanner::add(const AppliedLoad& load, std::optional<PrescribedPath> path) {
  loads_.push_back(load);
  prescribed_.push_back(std::move(path));
}

EnvironmentBody FlightPlanner::environmentBody(int index, const Body& body) const {
  return {&surfaces_[at(solid_of_[at(index)])], &body.inertia, body.material.drag_coefficient,
          &loads_[at(index)], &body.locks};
}

// Whether more than even acceleration acts on the body on its way.
bool FlightPlanner::isTouched(int index, const Body& body, double rest_of_step_s) const {
  if (loads_[at(index)].bends()) return true;
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
  const Quat& R_WB = body.path.X_WB.rotation;
  const Vec3& spin = body.momentum_velocity.angular;
  const double dt = step_s_ - body.path.start_s;
  body.solved_spin_B = R_WB.conjugate() * spin;
  body.turning_B = Vec3::Zero();
  if (dt > 0.0) body.turning_B = R_WB.conjugate() * body.spinGained(body.inertia, R_WB, spin, dt) / dt;
}

// What a force and gravity make of the body's velocity, m/s^2.
Vec3 FlightPlanner::accelerationBy(const Vec3& force_W, const Body& body) const {
  Vec3 acceleration = environment_.gravity;
  if (!force_W.isZero(0.0)) acceleration += body.inertia.inverse_mass * force_W;
  return body.locks.any() ? body.locks.movingPart(acceleration) : acceleration;
}

Vec3 FlightPlanner::parabolaOf(int index, const Body& body) const {
  return accelerationBy(loads_[at(index)].force_W, body);
}

Vec3 FlightPlanner::pull(int index, const Body& body) const {
  return accelerationBy(loads_[at(index)].force(body.X_WB.rotation), body);
}

void FlightPlanner::planPath(int index, Body& body) const {
  Trajectory& path = body.path;
  const double dt = step_s_ - path.start_s;
  const Velocity& start = body.momentum_velocity;
  path.velocity = start.linear;
  path.acceleration = parabolaOf(index, body);
  body.acceleration = path.acceleration;
  body.torque.setZero();
  body.turning_power.reset();
  if (!(dt > 0.0) || surfaces_.empty() || !isTouched(index, body, dt)) {
    turnFreely(body, dt);
    return;
  }
  const EnvironmentFlight flight = flyThroughEnvironment(
      {environment_, environmentBody(index, body), {body.contact_force, body.contact_torque}}, path.X_WB,
      start, time_s_ + path.start_s, dt, *scratch_->acquire());
  Vec3 mean = (flight.X_end.position - path.X_WB.position) / dt;
  const Vec3 momentum = angularMomentum(body.inertia, path.X_WB.rotation, start.angular);
  path.acceleration = (flight.velocity_end - start.linear) / dt;
  body.acceleration = path.acceleration - body.inertia.inverse_mass * body.contact_force;
  body.torque = (flight.angular_momentum_end - momentum) / dt - body.contact_torque;
  path.turnAt(body.locks.turningPart(flight.spin));
  path.tumbling = flight.tumbling;  // of a body whose turning is locked there is none
  if (!path.tumbling.empty() && !isVacuum())
    body.turning_power = (flight.turning_energy_end_J - 0.5 * dot(start.angular, momentum)) / dt;
  if (body.locks.any()) {
    mean = body.locks.movingPart(mean);
    path.acceleration = body.locks.movingPart(path.acceleration);
    body.acceleration = body.locks.movingPart(body.acceleration);
    body.torque = body.locks.turningPart(body.torque);
  }
  const double swing = 0.5 * dt * path.acceleration.norm();
  if (path.acceleration.norm() > kBraking * environment_.gravity.norm() && swing > mean.norm())
    path.acceleration *= mean.norm() / swing;
  path.velocity = mean - (0.5 * dt) * path.acceleration;
}

void FlightPlanner::drive(int index, Body& body) const {
  const double start_s = body.path.start_s;
  const PrescribedPath::Piece piece =
      prescribed_[at(index)]->pieceAt(time_s_ - body.late_s + start_s, kSameTime * step_s_);
  body.travel = Travel::kDriven;
  body.path = piece.path;
  body.path.start_s = start_s;
  body.piece_end_s = start_s + piece.end_s;
  body.momentum_velocity = {piece.path.velocity, piece.path.spin};
  body.acceleration = piece.path.acceleration;
  body.torque.setZero();
}

void FlightPlanner::endDrive(int index, Body& body) const {
  body.was_stopped = body.travel == Travel::kHeld;
  if (body.was_stopped) body.late_s += step_s_ - body.path.start_s;
  const double end_s = time_s_ + step_s_ - body.late_s;
  const Trajectory path = prescribed_[at(index)]->pieceAt(end_s, kSameTime * step_s_).path;
  body.X_WB = path.X_WB;
  body.velocity = body.was_stopped ? Velocity{} : Velocity{path.velocity, path.spin};
}

void FlightPlanner::planStep(int index, Body& body) const {
  if (body.is_kinematic) {
    body.path.start_s = 0.0;
    drive(index, body);
    // One that was stopped presses nothing until its way is found to be free.
    body.velocity = body.was_stopped ? Velocity{} : body.momentum_velocity;
    return;
  }
  body.travel = Travel::kBallistic;
  body.path = Trajectory{0.0, body.X_WB, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  body.momentum_velocity = body.velocity;
  body.pull_W = body.pull.steady;
  body.place_sum.setZero();
  body.load_work_J = 0.0;
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
  if (body.is_kinematic) {
    if (body.was_stopped) return {};
    return {dt * body.path.acceleration, dt * body.path.spin_change.rate};
  }
  return {gravityImpulsePerMass(body.acceleration, dt),
          body.spinGained(body.inertia, body.path.X_WB.rotation, body.momentum_velocity.angular, dt)};
}

Velocity FlightPlanner::gainedFrom(int index, const Body& body, double start_s,
                                   const Velocity& velocity) const {
  Body flying = body;
  flying.travel = Travel::kBallistic;
  flying.path.X_WB = body.path.at(start_s);
  flying.path.start_s = start_s;
  flying.momentum_velocity = velocity;
  plan(index, flying);
  return gained(flying);
}

Velocity FlightPlanner::pushAtRest(int index, const Body& body) const {
  if (surfaces_.empty()) return {step_s_ * parabolaOf(index, body), Vec3::Zero()};
  const BodyForces forces = bodyForces(environment_, environmentBody(index, body), body.X_WB, Vec6::Zero(),
                                       time_s_ + step_s_, *scratch_->acquire());
  const Vec6 wrench = forces.total(Vec6::Zero());
  const Quat& R_WB = body.X_WB.rotation;
  const Velocity push{step_s_ * body.inertia.inverse_mass * (R_WB * wrench.head<3>()),
                      step_s_ * (R_WB * (body.inertia.inverse_tensor_B * wrench.tail<3>()))};
  if (!body.locks.any()) return push;
  return {body.locks.movingPart(push.linear), body.locks.turningPart(push.angular)};
}

bool FlightPlanner::isWeightAll(int index, const Body& body) const {
  return isVacuum() && loads_[at(index)].isZero() && !body.locks.any();
}

// What the load is in the mean over the path, in the world. Without air and fluids it is all but gravity that
// acts in flight; else it is taken halfway.
AppliedLoad FlightPlanner::meanLoad(int index, const Body& body, double end_s) const {
  if (isVacuum() && body.travel == Travel::kBallistic)
    return {body.inertia.mass_kg * (body.acceleration - environment_.gravity), body.torque};
  const AppliedLoad& load = loads_[at(index)];
  const Quat R_WB = body.path.at(0.5 * (body.path.start_s + end_s)).rotation;
  return {load.force(R_WB), load.torque(R_WB)};
}

double FlightPlanner::workOfLoad(int index, const Body& body, double end_s) const {
  const AppliedLoad& load = loads_[at(index)];
  if (load.isZero() || !body.moves()) return 0.0;
  const Trajectory& path = body.path;
  const Vec3 way = path.positionAt(end_s) - path.X_WB.position;
  if (!load.bends()) return dot(load.force_W, way);
  const AppliedLoad mean = meanLoad(index, body, end_s);
  return dot(mean.force_W, way) + dot(mean.torque_W, turnedBy(body, step_s_, end_s));
}

double FlightPlanner::countWorkOfLoad(int index, Body& body, double end_s) const {
  const double work_J = workOfLoad(index, body, end_s);
  body.load_work_J += work_J;
  return work_J;
}

bool FlightPlanner::restless(const Body& body) const {
  return std::any_of(environment_.fluids.begin(), environment_.fluids.end(), [&](const Fluid& fluid) {
    return !fluid.waves.empty() && reaches(fluid, body.X_WB.position, body.radius_m);
  });
}

double FlightPlanner::potential(int index, const Body& body) const {
  double energy = gravityPotential(body.inertia, environment_.gravity, body.X_WB.position);
  if (surfaces_.empty()) return energy;  // vacuum, or a world not started
  return energy + buoyancyPotential(environment_, surfaces_[at(solid_of_[at(index)])], body.X_WB, time_s_,
                                    *scratch_->acquire());
}

}  // namespace carom
