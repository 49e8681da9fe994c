#include "engine/simulation/contacts/lasting_contact.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "engine/foundation/index.h"
#include "engine/modes/islands.h"
#include "engine/response/conjugate_sweeps.h"
#include "engine/response/standing_solver.h"
#include "engine/response/sweeps/energy_bound.h"
#include "engine/response/sweeps/no_room.h"
#include "engine/response/sweeps/turning_resistance.h"
#include "engine/simulation/contacts/contact_paths.h"

namespace carom {
namespace {

constexpr int kLandingSweeps = 8;  // over rows that landings stir; the next step solves on

// Of each body, whether it lies still; what rests and what is static do.
std::span<const char> stillBodies(const LastingWorld& world, LastingContacts& contacts) {
  contacts.room.still.resize(world.bodies.size(), 1);
  for (const int i : world.active.list()) {
    const Body& body = world.bodies[at(i)];
    contacts.room.still[at(i)] = body.moves() ? body.liesStill() : !body.isDriven() || body.was_stopped;
  }
  return contacts.room.still;
}

// What lies still and presses holds at the gap it has: closing it would keep all around it from coming to
// rest.
void holdStillGaps(LastingContacts& contacts, std::span<const char> still) {
  for (ContactRow& row : contacts.rows)
    if (row.impulse.x() > 0.0 && still[at(row.a)] && still[at(row.b)])
      row.lowest_speed = std::max(0.0, row.lowest_speed);
}

// Whether an island lies still, all of it.
bool liesStill(std::span<const ContactRow> rows, std::span<const char> still) {
  return std::all_of(rows.begin(), rows.end(),
                     [&](const ContactRow& row) { return still[at(row.a)] && still[at(row.b)]; });
}

// With steps that solve all held rows at once. While some body moves, its rows, taken as equations, would
// contradict each other.
SolverReport solveStillIsland(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double push_mps,
                              Crew& crew) {
  const int sweeps = sweepsInBudget(rows.size());
  const bool careful = sweeps >= tolerance::kSolverSweeps;
  return solveStandingContacts(
      rows, bodies,
      {.sweeps = std::max(sweeps, tolerance::kSolverSweeps),
       .residual_mps = (careful ? tolerance::kSolverResidual : tolerance::kSolverStandingResidual) * push_mps,
       .most_products = tolerance::kSolverDearProducts * static_cast<long>(rows.size()),
       .crew = &crew});
}

// Carefully for its share of the budget, and coarsely for longer; a crowd in motion is solved on in the next
// step.
SolverReport solveMovingIsland(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, int careful_sweeps,
                               int most_sweeps, double push_mps, Crew& crew) {
  return solveContactsFinely(rows, bodies,
                             {.sweeps = most_sweeps,
                              .residual_mps = tolerance::kSolverResidual * push_mps,
                              .careful_sweeps = careful_sweeps,
                              .coarse_residual_mps = tolerance::kSolverCoarseResidual * push_mps,
                              .crew = &crew});
}

// Whether an island's rows miss their bounds by so much that gaps could be used up within the step.
bool missesBounds(const LastingContacts& contacts, const LastingContacts::Island& island,
                  const LastingWorld& world) {
  const auto pairs = contacts.pairsOf(island);
  return std::any_of(pairs.begin(), pairs.end(), [&](const LastingContacts::PairRows& of_pair) {
    const CollisionWindow& window = world.table.pairs()[at(of_pair.pair)].window;
    const double safe = safeResidual(window, world.settings.step_s);
    for (std::size_t i = of_pair.begin; i < of_pair.end; ++i)
      if (-rowMiss(contacts.rows[i], contacts.bodies).x() > safe) return true;
    return false;
  });
}

bool hasDriven(std::span<const ContactRow> rows, const std::vector<Body>& bodies) {
  return std::any_of(rows.begin(), rows.end(), [&](const ContactRow& row) {
    return bodies[at(row.a)].travel == Travel::kDriven || bodies[at(row.b)].travel == Travel::kDriven;
  });
}

// Kinematic bodies that leave others no room stop where they are, for the step. Returns the islands that are
// to be solved anew.
std::vector<std::size_t> stopWhatLeavesNoRoom(LastingContacts& contacts, std::span<const std::size_t> islands,
                                              const LastingWorld& world, StepCounters& counters) {
  std::vector<int> stopped;
  for (const std::size_t i : islands) {
    const std::span<ContactRow> rows = contacts.rowsOf(contacts.islands[i]);
    if (!hasDriven(rows, world.bodies) || !missesBounds(contacts, contacts.islands[i], world)) continue;
    const std::vector<int> driven = leavingNoRoom(rows, contacts.bodies, true);
    for (const int body : driven) {
      stopKinematic(world.bodies[at(body)]);
      contacts.bodies[at(body)].velocity = contacts.before[at(body)] = contacts.gained[at(body)] = {};
      ++counters.stopped_kinematic;
    }
    stopped.insert(stopped.end(), driven.begin(), driven.end());
  }
  std::vector<std::size_t> again;
  for (const std::size_t i : islands) {
    const std::span<ContactRow> rows = contacts.rowsOf(contacts.islands[i]);
    const auto isStopped = [&](int body) {
      return std::find(stopped.begin(), stopped.end(), body) != stopped.end();
    };
    if (!std::any_of(rows.begin(), rows.end(),
                     [&](const ContactRow& row) { return isStopped(row.a) || isStopped(row.b); }))
      continue;
    undoLoads(rows, contacts.bodies);
    again.push_back(i);
  }
  return again;
}

// With friction.
void solveImpulses(LastingContacts& contacts, std::span<const std::size_t> islands, const LastingWorld& world,
                   StepCounters& counters) {
  const std::span<const char> still = stillBodies(world, contacts);
  holdStillGaps(contacts, still);
  const int most_sweeps =
      std::max(tolerance::kSolverSweeps,
               tolerance::kSolverMostVisits / std::max(1, static_cast<int>(contacts.rows.size())));
  const auto solve = [&](std::size_t island, int sweeps, bool again) {
    const std::span<ContactRow> rows = contacts.rowsOf(contacts.islands[island]);
    const double push_mps = contacts.islands[island].push_mps;
    if (!again && liesStill(rows, still)) {
      counters.row_visits += solveStillIsland(rows, contacts.bodies, push_mps, world.crew).visits;
      return SolverReport{};  // it has budgets of its own
    }
    return solveMovingIsland(rows, contacts.bodies, sweeps, again ? sweeps : std::max(sweeps, most_sweeps),
                             push_mps, world.crew);
  };
  const auto enough = [&](std::size_t island) {
    return tolerance::kSolverResidual * contacts.islands[island].push_mps;
  };
  // Each round stops a kinematic body, or is the last.
  for (std::vector<std::size_t> unsolved(islands.begin(), islands.end()); !unsolved.empty();
       unsolved = stopWhatLeavesNoRoom(contacts, unsolved, world, counters))
    counters.row_visits += solveWithinBudget(contacts, unsolved, enough, solve);
  for (const std::size_t island : islands)
    takeBackWork(contacts.rowsOf(contacts.islands[island]), contacts.bodies, contacts.before);
}

// The impulse of gravity and of what else surrounds the body over the step.
void giveEnvironment(LastingContacts& contacts, const LastingWorld& world, const FlightPlanner& planner) {
  const std::vector<Body>& bodies = world.bodies;
  contacts.gained.resize(bodies.size());
  contacts.before.resize(bodies.size());
  for (const int active : world.active.list()) {
    const std::size_t i = at(active);
    contacts.gained[i] = {};
    contacts.before[i] = contacts.bodies[i].velocity;
    if (!bodies[i].travels()) continue;
    contacts.gained[i] = planner.gained(bodies[i]);
    contacts.bodies[i].velocity.linear += contacts.gained[i].linear;
    contacts.bodies[i].velocity.angular += contacts.gained[i].angular;
  }
}

// Gives the bodies the impulses that rows begin with. What an island remembers of another arrangement may be
// far too much for this one, and few sweeps would leave some of that in its bodies.
void warmUp(LastingContacts& contacts) {
  for (const ContactRow& row : contacts.rows) applyLoad(row, contacts.bodies);
  for (const LastingContacts::Island& island : contacts.islands)
    takeBackGain(contacts.rowsOf(island), contacts.bodies);
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

// For the next step's plans: what contacts have given; nothing to a body in flight, which must not be planned
// as if something held it.
void foreseeContacts(const LastingContacts& contacts, int index, Body& body, const FlightPlanner& planner) {
  const auto i = at(index);
  if (!contacts.touched[i]) {
    planner.leaveContacts(index, body);
    return;
  }
  const Velocity& after = contacts.bodies[i].velocity;
  const Velocity& gained = contacts.gained[i];
  planner.takeContacts(body,
                       {after.linear - body.velocity.linear - gained.linear,
                        after.angular - contacts.half_turns[i].spin - gained.angular},
                       contacts.half_turns[i].R_WB);
}

void remember(const LastingContacts& contacts, std::span<const LastingContacts::PairRows> pairs,
              const LastingWorld& world) {
  const double step_s = world.settings.step_s;
  world.crew.runStretches(pairs.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const LastingContacts::PairRows& of_pair = pairs[k];
      ShapePair& pair = world.table.pairs()[at(of_pair.pair)];
      pair.remembered.clear();
      for (std::size_t i = of_pair.begin; i < of_pair.end; ++i) {
        const ContactRow& row = contacts.rows[i];
        const Vec3 impulse_W = rowImpulse(row, row.impulse);
        const Vec3 torque_impulse_W = rowImpulse(row, row.torque);
        pair.remembered.push_back({.id = contacts.sources[i].id,
                                   .impulse_W = impulse_W,
                                   .force_W = impulse_W / step_s,
                                   .n_W = row.n,
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
  warmUp(contacts);
  std::vector<std::size_t> islands(contacts.islands.size());
  std::iota(islands.begin(), islands.end(), std::size_t{0});
  solveImpulses(contacts, islands, world, counters);
  findTouched(contacts, world);
  for (const int i : world.active.list())
    if (world.bodies[at(i)].moves()) foreseeContacts(contacts, i, world.bodies[at(i)], planner);
  setContactPaths(world, islands, counters, contacts);
  remember(contacts, contacts.pair_rows, world);
  counters.contact_points = static_cast<int>(contacts.rows.size());
}

std::vector<int> crowdedLandings(std::span<const int> pairs, const LastingWorld& world,
                                 LastingContacts& contacts) {
  const auto moves = [&](int body) { return world.bodies[at(body)].moves(); };
  Islands& joined = contacts.room.joined;
  joined.part(static_cast<int>(world.bodies.size()));
  const auto join = [&](int index) {
    const ShapePair& pair = world.table.pairs()[at(index)];
    if (moves(pair.body_a) && moves(pair.body_b)) joined.join(pair.body_a, pair.body_b);
  };
  for (const LastingContacts::PairRows& of_pair : contacts.pair_rows) join(of_pair.pair);
  for (const int pair : pairs) join(pair);
  return crowdedLandings(pairs, world, contacts.rows.size(), joined);
}

std::vector<int> solveLandings(std::span<const int> pairs, const LastingWorld& world,
                               const FlightPlanner& planner, StepCounters& counters,
                               LastingContacts& contacts) {
  const std::vector<std::size_t> islands = addLandings(world, pairs, counters, contacts);
  std::vector<int> bodies = contacts.bodiesOf(islands);
  for (const int i : bodies) contacts.bodies[at(i)].stir = 0.0;
  for (const std::size_t i : islands) {
    const std::span<ContactRow> rows = contacts.rowsOf(contacts.islands[i]);
    const double push_mps = contacts.islands[i].push_mps;
    const SolverReport report = solveContacts(rows, contacts.bodies,
                                              {.sweeps = kLandingSweeps,
                                               .residual_mps = tolerance::kSolverCoarseResidual * push_mps,
                                               .resumes = true,
                                               .crew = &world.crew});
    takeBackWork(rows, contacts.bodies, contacts.before);
    counters.row_visits += report.visits;
  }
  findTouched(contacts, world);
  std::erase_if(bodies, [&](int i) { return !world.bodies[at(i)].moves(); });
  for (const int i : bodies) {
    Body& body = world.bodies[at(i)];
    if (!contacts.touched[at(i)] && body.travel != Travel::kBallistic)
      planner.planStep(i, body);  // nothing presses it any more
    foreseeContacts(contacts, i, body, planner);
  }
  setContactPaths(world, islands, counters, contacts);
  for (const std::size_t i : islands) remember(contacts, contacts.pairsOf(contacts.islands[i]), world);
  counters.landings += static_cast<int>(pairs.size());
  counters.contact_points = static_cast<int>(contacts.rows.size());
  return bodies;
}

}  // namespace carom
