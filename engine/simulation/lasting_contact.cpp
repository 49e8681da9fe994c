#include "engine/simulation/lasting_contact.h"

#include <algorithm>
#include <atomic>

#include "engine/response/focused_solver.h"
#include "engine/response/standing_solver.h"
#include "engine/simulation/contact_paths.h"
#include "engine/simulation/solver_patience.h"

namespace carom {
namespace {

constexpr double kFewMoving = 0.05;  // of a crowd's bodies: so many falling about do not set it in motion

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

std::span<const BodyMotion> motionsOf(const LastingWorld& world, LastingContacts& contacts) {
  contacts.room.motions.resize(world.bodies.size());
  const std::span<const int> active = world.active.list();
  world.crew.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Body& body = world.bodies[at(active[k])];
      BodyMotion& motion = contacts.room.motions[at(active[k])];
      motion = {};
      if (!body.moves()) continue;
      motion = {1.0 / body.inertia.inverse_mass,
                body.velocity.linear.norm() + body.velocity.angular.norm() * body.radius_m, body.liesStill()};
    }
  });
  return contacts.room.motions;
}

// Whether an island lies still but for a few of its bodies: in the mean by mass, or, of a crowd, nearly all
// of them. A body counts as often as it has rows.
bool stands(std::span<const ContactRow> rows, std::span<const BodyMotion> motions) {
  double twice_energy = 0.0;  // of bodies that turn with their whole mass at their radius
  double mass = 0.0;
  int all = 0, moving = 0;
  for (const ContactRow& row : rows) {
    for (const int i : {row.a, row.b}) {
      const BodyMotion& body = motions[at(i)];
      if (body.mass_kg == 0.0) continue;
      ++all;
      if (!(body.speed_mps < tolerance::kRestSpeed)) ++moving;
      mass += body.mass_kg;
      twice_energy += body.mass_kg * body.speed_mps * body.speed_mps;
    }
  }
  if (rows.size() >= kFocusedRows && moving <= kFewMoving * all) return true;
  return twice_energy <= mass * tolerance::kRestSpeed * tolerance::kRestSpeed;
}

bool isStirred(std::span<const ContactRow> rows, std::span<const BodyMotion> motions) {
  return std::any_of(rows.begin(), rows.end(), [&](const ContactRow& row) {
    return !motions[at(row.a)].lies_still || !motions[at(row.b)].lies_still;
  });
}

// How many sweeps an island's share of row visits goes for.
int shareOfSweeps(std::span<const ContactRow> rows) {
  return tolerance::kSolverRowVisits / static_cast<int>(rows.size());
}

// The least sweeps of an island that stands but for what moves in it.
int fewestSweeps(std::span<const ContactRow> rows) {
  return rows.size() < kFocusedRows ? tolerance::kSolverSweeps : tolerance::kSolverFocusedSweeps;
}

// Of an island that lies still, before its rows are solved at once.
int standingSweeps(std::span<const ContactRow> rows) {
  return rows.size() < kFocusedRows ? tolerance::kSolverStandingSweeps
                                    : tolerance::kSolverCrowdStandingSweeps;
}

// Small islands are solved to the fine residual, large ones to a coarser one.
double residualOf(std::span<const ContactRow> rows, double coarser) {
  return shareOfSweeps(rows) >= tolerance::kSolverSweeps ? tolerance::kSolverResidual : coarser;
}

// What lies still, all of it.
void solveStillIsland(std::span<ContactRow> rows, std::vector<Body>& bodies,
                      std::span<ImpulseBody> solver_bodies, double gravity_speed, Crew& crew) {
  SolverSettings settings{
      .sweeps = std::max(shareOfSweeps(rows), standingSweeps(rows)),
      .residual_mps = residualOf(rows, tolerance::kSolverStandingResidual) * gravity_speed,
      .most_products = tolerance::kSolverDearProducts * static_cast<long>(rows.size()),
      .crew = &crew};
  SolverPatience patience(rows, bodies);
  if (patience.isLost()) {
    settings.sweeps = std::max(shareOfSweeps(rows), fewestSweeps(rows));
    settings.residual_mps = tolerance::kSolverCrowdResidual * gravity_speed;
    settings.in_the_mean = true;
    solveContactsFocused(rows, solver_bodies, settings);
    patience.waitAStep();
    return;
  }
  patience.learn(solveStandingContacts(rows, solver_bodies, settings), settings.residual_mps);
}

// While some body still moves in it, sweeps are enough: the loads change from step to step, and its rows,
// taken as equations, would contradict each other.
void solveStandingIsland(std::span<ContactRow> rows, std::span<const BodyMotion> motions,
                         std::vector<Body>& bodies, std::span<ImpulseBody> solver_bodies,
                         double gravity_speed, Crew& crew) {
  // What presses holds at the gap it has: closing it would keep the rest from lying still.
  for (ContactRow& row : rows)
    if (row.impulse.x() > 0.0) row.lowest_speed = std::max(0.0, row.lowest_speed);
  if (!isStirred(rows, motions)) {
    solveStillIsland(rows, bodies, solver_bodies, gravity_speed, crew);
    return;
  }
  solveContactsFocused(rows, solver_bodies,
                       {.sweeps = std::max(shareOfSweeps(rows), fewestSweeps(rows)),
                        .residual_mps = residualOf(rows, tolerance::kSolverStirredResidual) * gravity_speed,
                        .in_the_mean = rows.size() >= kFocusedRows,
                        .crew = &crew});
}

// Carefully as far as its share of row visits goes; what has just come together there and would fall apart in
// a coarse step, farther.
void solveMovingIsland(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double gravity_speed,
                       Crew& crew) {
  const double residual = residualOf(rows, tolerance::kSolverCoarseResidual);
  const int careful_sweeps = std::max(shareOfSweeps(rows), tolerance::kSolverSweeps);
  const int most_sweeps = tolerance::kSolverMostVisits / static_cast<int>(rows.size());
  solveContactsFocused(rows, bodies,
                       {.sweeps = std::max(careful_sweeps, most_sweeps),
                        .residual_mps = residual * gravity_speed,
                        .careful_sweeps = careful_sweeps,
                        .coarse_residual_mps = tolerance::kSolverCoarseResidual * gravity_speed,
                        .crew = &crew});
}

// With friction.
void solveImpulses(const LastingWorld& world, LastingContacts& contacts) {
  std::vector<Body>& bodies = world.bodies;
  const double gravity_speed = world.settings.gravity.norm() * world.settings.step_s;
  Crew& crew = world.crew;
  const std::span<const BodyMotion> motions = motionsOf(world, contacts);
  for (std::size_t i = 0; i + 1 < contacts.island_begin.size(); ++i) {
    const std::size_t count = contacts.island_begin[i + 1] - contacts.island_begin[i];
    const std::span<ContactRow> rows = std::span(contacts.rows).subspan(contacts.island_begin[i], count);
    if (stands(rows, motions))
      solveStandingIsland(rows, motions, bodies, contacts.bodies, gravity_speed, crew);
    else
      solveMovingIsland(rows, contacts.bodies, gravity_speed, crew);
  }
}

// The impulse of gravity and of what else surrounds the body over the step.
void giveEnvironment(LastingContacts& contacts, const LastingWorld& world, const FlightPlanner& planner) {
  const std::vector<Body>& bodies = world.bodies;
  for (const int active : world.active.list()) {
    const std::size_t i = at(active);
    if (!bodies[i].moves()) continue;
    const Velocity gained = planner.gained(bodies[i]);
    contacts.bodies[i].velocity.linear += gained.linear;
    contacts.bodies[i].velocity.angular += gained.angular;
  }
}

// The moving bodies that some row presses.
void findTouched(LastingContacts& contacts, const LastingWorld& world) {
  const std::vector<Body>& bodies = world.bodies;
  contacts.touched.resize(bodies.size(), 0);
  for (const int i : world.active.list()) contacts.touched[at(i)] = 0;
  world.crew.runStretches(contacts.rows.size(), kFewRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const ContactRow& row = contacts.rows[k];
      if (row.impulse.isZero(0.0)) continue;
      for (const int i : {row.a, row.b})
        if (bodies[at(i)].moves())
          std::atomic_ref(contacts.touched[at(i)]).store(1, std::memory_order_relaxed);
    }
  });
}

// For the next step's plans: what contacts have given; nothing to bodies in flight, which must not be planned
// as if something held them.
void foreseeContacts(const LastingContacts& contacts, const LastingWorld& world,
                     const FlightPlanner& planner) {
  std::vector<Body>& bodies = world.bodies;
  for (const int active : world.active.list()) {
    const std::size_t i = at(active);
    if (!bodies[i].moves()) continue;
    if (!contacts.touched[i]) {
      planner.leaveContacts(static_cast<int>(i), bodies[i]);
      continue;
    }
    const Velocity gained = planner.gained(bodies[i]);
    planner.takeContacts(bodies[i],
                         {contacts.bodies[i].velocity.linear - bodies[i].velocity.linear - gained.linear,
                          contacts.bodies[i].velocity.angular - contacts.half_turns[i].spin - gained.angular},
                         contacts.half_turns[i].R_WB);
  }
}

void remember(const LastingContacts& contacts, const LastingWorld& world) {
  const double step_s = world.settings.step_s;
  world.crew.runStretches(contacts.pair_rows.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const LastingContacts::PairRows& of_pair = contacts.pair_rows[k];
      ShapePair& pair = world.table.pairs()[at(of_pair.pair)];
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        const ContactRow& row = contacts.rows[i];
        const Vec3 impulse_W = rowImpulse(row, row.impulse);
        const Vec3 torque_impulse_W = rowImpulse(row, row.torque);
        pair.remembered.push_back({.id = contacts.sources[i].id,
                                   .impulse_W = impulse_W,
                                   .force_W = impulse_W / step_s,
                                   .arm_a = row.r_a,
                                   .arm_b = row.r_b,
                                   .torque_impulse_W = torque_impulse_W,
                                   .torque_W = torque_impulse_W / step_s});
      }
    }
  });
}

}  // namespace

void correctLoad(const LastingContacts& contacts, std::size_t row, const RowLoad& load, double step_s,
                 std::vector<ShapePair>& pairs) {
  const ContactRow& corrected = contacts.rows[row];
  const RowSource& source = contacts.sources[row];
  ShapePair& pair = pairs[at(source.pair)];
  // Pairs may have been collected anew since.
  if (pair.body_a != corrected.a || pair.body_b != corrected.b) return;
  for (RememberedImpulse& remembered : pair.remembered) {
    if (remembered.id != source.id) continue;
    remembered.impulse_W = rowImpulse(corrected, load.impulse);
    remembered.force_W = remembered.impulse_W / step_s;
    remembered.torque_impulse_W = rowImpulse(corrected, load.torque);
    remembered.torque_W = remembered.torque_impulse_W / step_s;
  }
}

bool wakePressed(const LastingWorld& world, const LastingContacts& contacts) {
  bool woken = false;
  for (const ContactRow& row : contacts.rows) {
    if (!(row.impulse.x() > 0.0)) continue;
    for (int i : {row.a, row.b}) {
      if (!world.bodies[at(i)].resting) continue;
      for (const int member : world.active.wakeIsland(world.bodies, i))
        world.table.activate(member, world.bodies, world.settings);
      woken = true;
    }
  }
  return woken;
}

void solveLastingContacts(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
                          LastingContacts& contacts) {
  assembleContacts(world, counters, contacts);
  giveEnvironment(contacts, world, planner);
  for (const ContactRow& row : contacts.rows) applyLoad(row, contacts.bodies);
  solveImpulses(world, contacts);
  findTouched(contacts, world);
  foreseeContacts(contacts, world, planner);
  setContactPaths(world, counters, contacts);
  remember(contacts, world);
  counters.contact_points = static_cast<int>(contacts.rows.size());
}

}  // namespace carom
