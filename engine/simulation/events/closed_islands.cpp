#include "engine/simulation/events/closed_islands.h"

#include <algorithm>
#include <cmath>

#include "engine/foundation/index.h"

namespace carom {
namespace {

constexpr double kRounding = 1e-15;  // of the terms of a sum

Vec3 spinMomentum(const Body& body) {
  if (body.kept_angular_momentum) return *body.kept_angular_momentum;
  return angularMomentum(body.inertia, body.X_WB.rotation, body.velocity.angular);
}

Mat3 tensorAbout(const Vec3& r, const Body& body) {
  const Mat3 R = body.X_WB.rotation.toRotationMatrix();
  const Mat3 parallel = dot(r, r) * Mat3::Identity() - r * r.transpose();
  return R * body.inertia.tensor_B * R.transpose() + body.inertia.mass_kg * parallel;
}

}  // namespace

void ClosedIslands::begin(std::size_t bodies) {
  for (const int i : met_) is_open_[at(i)] = has_met_[at(i)] = 0;
  met_.clear();
  together_.part(static_cast<int>(bodies));
  islands_.resize(bodies);
  is_open_.resize(bodies);
  has_met_.resize(bodies);
  met_.reserve(bodies);
}

void ClosedIslands::note(int body, bool open) {
  if (!has_met_[at(body)]) met_.push_back(body);
  has_met_[at(body)] = 1;
  is_open_[at(body)] |= static_cast<unsigned char>(open);
}

void ClosedIslands::meet(int a, int b, const std::vector<Body>& bodies) {
  const bool a_moves = bodies[at(a)].moves(), b_moves = bodies[at(b)].moves();
  if (a_moves) note(a, !b_moves);
  if (b_moves) note(b, !a_moves);
  if (a_moves && b_moves) together_.join(a, b);
}

void ClosedIslands::findCenters(const std::vector<Body>& bodies) {
  for (const int i : met_) {
    Island& island = islandOf(i);
    if (island.open) continue;
    const Body& body = bodies[at(i)];
    island.mass_kg += body.inertia.mass_kg;
    island.center += body.inertia.mass_kg * body.X_WB.position;
    island.velocity += body.inertia.mass_kg * body.velocity.linear;
  }
  for (const int i : met_) {
    Island& island = islands_[at(i)];
    if (together_.of(i) != i || island.open) continue;
    island.center /= island.mass_kg;
    island.velocity /= island.mass_kg;
  }
}

void ClosedIslands::findMomenta(const std::vector<Body>& bodies) {
  for (const int i : met_) {
    Island& island = islandOf(i);
    if (island.open) continue;
    const Body& body = bodies[at(i)];
    const Vec3 r = body.X_WB.position - island.center;
    const Vec3 v = body.velocity.linear - island.velocity;
    const Vec3 spin = spinMomentum(body);
    island.angular_momentum += body.inertia.mass_kg * r.cross(v) + spin;
    island.terms += body.inertia.mass_kg * r.norm() * body.velocity.linear.norm() + spin.norm();
    island.tensor += tensorAbout(r, body);
    island.energy_J += kineticEnergy(body.inertia, body.X_WB.rotation, {v, body.velocity.angular});
  }
}

// What loads would give about the centre if nothing moved.
void ClosedIslands::findMoments(const std::vector<Body>& bodies, const FlightPlanner& planner) {
  for (const int i : met_) {
    Island& island = islandOf(i);
    const AppliedLoad& load = planner.load(i);
    if (island.open || island.untold || load.isZero()) continue;
    const Vec3 r = bodies[at(i)].X_WB.position - island.center;
    island.kept += planner.step_s() * (r.cross(load.force_W) + load.torque_W);
    island.force += load.force_W;
  }
}

// What they give more as the bodies go their ways, and the centre goes its own; and their work.
void ClosedIslands::followLoads(const std::vector<Body>& bodies, const FlightPlanner& planner) {
  for (const int i : met_) {
    Island& island = islandOf(i);
    if (island.open || island.untold || !island.loaded) continue;
    const Body& body = bodies[at(i)];
    const AppliedLoad& load = planner.load(i);
    const double arm = (body.X_WB.position - island.center).norm();
    island.terms += planner.step_s() * (arm * load.force_W.norm() + load.torque_W.norm());
    island.kept += body.place_sum.cross(load.force_W);
    island.place_sum += body.inertia.mass_kg * body.place_sum;
    island.kept_J += body.load_work_J;
    island.energy_terms += std::abs(body.load_work_J);
  }
  for (const int i : met_) {
    Island& island = islands_[at(i)];
    if (together_.of(i) != i || island.open || island.force.isZero(0.0)) continue;
    island.kept -= island.place_sum.cross(island.force) / island.mass_kg;
    island.kept_J -= dot(island.force, island.center - island.begun);
  }
}

void ClosedIslands::measure(const std::vector<Body>& bodies, const FlightPlanner& planner) {
  for (const int i : met_) islandOf(i) = {};
  for (const int i : met_) {
    islandOf(i).open |= is_open_[at(i)] != 0 || bodies[at(i)].locks.any();
    islandOf(i).loaded |= !planner.isWeightAll(i, bodies[at(i)]);
    islandOf(i).untold |= !planner.isVacuum() || planner.load(i).turnsAlong();
  }
  findCenters(bodies);
  findMomenta(bodies);
  findMoments(bodies, planner);
}

bool ClosedIslands::isClosed(int body) const {
  return has_met_[at(body)] != 0 && !islandOf(body).open;
}

bool ClosedIslands::owe(int body, double energy_J) {
  if (!isClosed(body)) return false;
  islandOf(body).owed_J += energy_J;
  return true;
}

// The energy that it has too much, J; less than none of what was lost.
double ClosedIslands::excessOf(const Island& island) {
  if (island.untold) return island.owed_J;
  const double excess_J = island.energy_J - island.kept_J;
  const double terms = island.energy_terms + island.energy_J;
  return std::abs(excess_J) <= kRounding * terms ? 0.0 : excess_J;
}

// Of all motions with this angular momentum the rotation of all together has the least energy.
void ClosedIslands::balance(Island& island) {
  const Vec3 missing = island.untold ? Vec3::Zero() : Vec3(island.kept - island.angular_momentum);
  const bool is_kept = missing.norm() <= kRounding * island.terms;
  const double excess_J = excessOf(island);
  if (is_kept && !(excess_J > 0.0)) return;
  const Mat3 inverse = island.tensor.inverse();
  island.spin = inverse * island.angular_momentum;
  if (!is_kept) island.spin_change = inverse * missing;
  const double beside_J = island.energy_J - 0.5 * dot(island.spin, island.angular_momentum);
  const double more_J = dot(island.spin + 0.5 * island.spin_change, missing) + excess_J;
  if (!(more_J > 0.0)) return;
  if (more_J > beside_J) {
    island.spin_change.setZero();
    if (excess_J > 0.0) island.share = 0.0;
    return;
  }
  island.share = std::sqrt(1.0 - more_J / beside_J);
}

void ClosedIslands::restore(std::vector<Body>& bodies, const FlightPlanner& planner) {
  for (const int i : met_) {
    if (together_.of(i) != i) continue;
    Island& island = islands_[at(i)];
    island = {.open = island.open,
              .loaded = island.loaded,
              .untold = island.untold,
              .owed_J = island.owed_J,
              .kept = island.kept + island.angular_momentum,
              .kept_J = island.energy_J,
              .energy_terms = island.energy_J,
              .begun = island.center,
              .force = island.force};
  }
  findCenters(bodies);
  followLoads(bodies, planner);
  findMomenta(bodies);
  for (const int i : met_)
    if (together_.of(i) == i && !islands_[at(i)].open) balance(islands_[at(i)]);
  for (const int i : met_) {
    const Island& island = islandOf(i);
    if (island.spin_change.isZero(0.0) && island.share == 1.0) continue;
    Body& body = bodies[at(i)];
    const Vec3 r = body.X_WB.position - island.center;
    Velocity& v = body.velocity;
    const double beside = 1.0 - island.share;
    v.linear += island.spin_change.cross(r) - beside * (v.linear - island.velocity - island.spin.cross(r));
    v.angular += island.spin_change - beside * (v.angular - island.spin);
    body.kept_angular_momentum.reset();
  }
}

}  // namespace carom
