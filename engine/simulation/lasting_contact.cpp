#include "engine/simulation/lasting_contact.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/modes/islands.h"
#include "engine/modes/resting.h"
#include "engine/response/focused_solver.h"
#include "engine/response/standing_solver.h"
#include "engine/simulation/carried_path.h"
#include "engine/simulation/midstep_rows.h"
#include "engine/simulation/solver_patience.h"
#include "engine/simulation/warm_start.h"

namespace carom {
namespace {

// Of the speed that gravity adds in a step: where turning changes less, arms stay. What swings so slowly
// gains energy from its gaps; and what only just stands (an arch near the limit) loses its hold if nothing is
// too slow.
constexpr double kNoticedTurning = 1e-6;
constexpr double kFewMoving = 0.05;  // of a crowd's bodies: so many falling about do not set it in motion
constexpr int kPathSweeps = 60;
constexpr int kFirstPathSweeps = 8;     // of a crowd; if they visited its rows more often than ...
constexpr long kPathsInMotion = 5;      // ... this in the mean, ...
constexpr int kPathFocusedSweeps = 24;  // ... it gets so many focused ones
constexpr double kPathResidual = 1e-9;  // m/s: over a step, far below any gap
constexpr double kPathShare =
    0.01;  // of the smallest rest gap: what the path of a step may be off in a crowd

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

bool liesStill(const Body& body) {
  return !body.moves() || carom::liesStill(body.velocity, body.radius_m);
}

// No slow point higher than this can come to the rest gap within the step: where faces are cut off at this
// height, the cut holds nothing, and a corner that comes down slowly is held as the corner that it is.
double lastingHeight(const ShapePair& pair, double step_s) {
  return pair.window.ceiling + pair.collision_speed_mps * step_s;
}

void addRows(LastingContacts& contacts, int index, const ShapePair& pair, const std::vector<Body>& bodies,
             const std::vector<Shape>& shapes, const WorldSettings& settings, StepCounters& counters) {
  const double step_s = settings.step_s;
  const RowRequest request{.pair = index,
                           .row_a = pair.body_a,
                           .row_b = pair.body_b,
                           .closest = &pair.closest,
                           .X_WA = bodies[at(pair.body_a)].X_WB,
                           .X_WB = bodies[at(pair.body_b)].X_WB,
                           .height_m = lastingHeight(pair, step_s)};
  const auto first = static_cast<std::ptrdiff_t>(contacts.sources.size());
  appendRows(request, pair, bodies, shapes, contacts.bodies, contacts.sources);
  // A point that comes in fast (the far edge of a falling box) has its own time of impact and restitution; so
  // will one that bounces up.
  const auto goes = [&](const SourcedRow& sourced) {
    const double speed = rowVelocity(sourced.row, contacts.bodies).x();
    return speed < -pair.collision_speed_mps || (pair.restitution > 0.0 && speed > pair.collision_speed_mps);
  };
  contacts.sources.erase(std::remove_if(contacts.sources.begin() + first, contacts.sources.end(), goes),
                         contacts.sources.end());
  const std::span<SourcedRow> rows(contacts.sources.begin() + first, contacts.sources.end());
  const MidStep mid{0.5 * step_s, kNoticedTurning * settings.gravity.norm() * step_s};
  moveToMidStep(request, pair, mid, bodies, shapes, contacts.bodies, rows, counters);
  warmStart(pair, liesStill(bodies[at(pair.body_a)]) && liesStill(bodies[at(pair.body_b)]), rows);
  for (SourcedRow& sourced : rows) {
    ContactRow& row = sourced.row;
    row.lowest_speed += gapSpeeds(sourced.gap_m, pair, step_s, row.impulse.x() > 0.0).momentum;
  }
}

// Rows of one island stand together; each island is solved on its own, so that one that converges slowly does
// not keep the others sweeping.
void sortByIsland(LastingContacts& contacts) {
  Islands islands(static_cast<int>(contacts.bodies.size()));
  const auto moves = [&](int i) { return contacts.bodies[at(i)].inverse_mass > 0.0; };
  for (const SourcedRow& s : contacts.sources)
    if (moves(s.row.a) && moves(s.row.b)) islands.join(s.row.a, s.row.b);
  std::vector<std::pair<int, std::size_t>> order;  // by island, and as they came
  order.reserve(contacts.sources.size());
  for (std::size_t i = 0; i < contacts.sources.size(); ++i) {
    const ContactRow& row = contacts.sources[i].row;
    order.emplace_back(islands.of(moves(row.a) ? row.a : row.b), i);
  }
  if (!std::is_sorted(order.begin(), order.end())) {
    std::sort(order.begin(), order.end());
    contacts.unsorted.swap(contacts.sources);
    contacts.sources.clear();
    for (const auto& [island, i] : order) contacts.sources.push_back(contacts.unsorted[i]);
  }
  contacts.island_begin.clear();
  contacts.rows.clear();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].first != order[i - 1].first) contacts.island_begin.push_back(i);
    contacts.rows.push_back(contacts.sources[i].row);
  }
  contacts.island_begin.push_back(contacts.sources.size());
}

// Whether an island lies still but for a few of its bodies: in the mean by mass, or, of a crowd, nearly all
// of them. A body counts as often as it has rows.
bool stands(std::span<const ContactRow> rows, const std::vector<Body>& bodies) {
  double twice_energy = 0.0;  // of bodies that turn with their whole mass at their radius
  double mass = 0.0;
  int all = 0, moving = 0;
  for (const ContactRow& row : rows) {
    for (const int i : {row.a, row.b}) {
      const Body& body = bodies[at(i)];
      if (!body.moves()) continue;
      const double m = 1.0 / body.inertia.inverse_mass;
      const double v = body.velocity.linear.norm() + body.velocity.angular.norm() * body.radius_m;
      ++all;
      if (!(v < tolerance::kRestSpeed)) ++moving;
      mass += m;
      twice_energy += m * v * v;
    }
  }
  if (rows.size() >= kFocusedRows && moving <= kFewMoving * all) return true;
  return twice_energy <= mass * tolerance::kRestSpeed * tolerance::kRestSpeed;
}

bool isStirred(std::span<const ContactRow> rows, const std::vector<Body>& bodies) {
  return std::any_of(rows.begin(), rows.end(), [&](const ContactRow& row) {
    return !liesStill(bodies[at(row.a)]) || !liesStill(bodies[at(row.b)]);
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
                      std::span<ImpulseBody> solver_bodies, double gravity_speed) {
  SolverSettings settings{
      .sweeps = std::max(shareOfSweeps(rows), standingSweeps(rows)),
      .residual_mps = residualOf(rows, tolerance::kSolverStandingResidual) * gravity_speed,
      .most_products = tolerance::kSolverDearProducts * static_cast<long>(rows.size())};
  SolverPatience patience(rows, bodies);
  if (patience.isLost()) {
    settings.sweeps = std::max(shareOfSweeps(rows), fewestSweeps(rows));
    settings.residual_mps = tolerance::kSolverStirredResidual * gravity_speed;
    solveContactsFocused(rows, solver_bodies, settings);
    patience.waitAStep();
    return;
  }
  patience.learn(solveStandingContacts(rows, solver_bodies, settings), settings.residual_mps);
}

// While some body still moves in it, sweeps are enough: the loads change from step to step, and its rows,
// taken as equations, would contradict each other.
void solveStandingIsland(std::span<ContactRow> rows, std::vector<Body>& bodies,
                         std::span<ImpulseBody> solver_bodies, double gravity_speed) {
  // What presses holds at the gap it has: closing it would keep the rest from lying still.
  for (ContactRow& row : rows)
    if (row.impulse.x() > 0.0) row.lowest_speed = std::max(0.0, row.lowest_speed);
  if (!isStirred(rows, bodies)) {
    solveStillIsland(rows, bodies, solver_bodies, gravity_speed);
    return;
  }
  solveContactsFocused(rows, solver_bodies,
                       {.sweeps = std::max(shareOfSweeps(rows), fewestSweeps(rows)),
                        .residual_mps = residualOf(rows, tolerance::kSolverStirredResidual) * gravity_speed});
}

// Carefully as far as its share of row visits goes; what has just come together there and would fall apart in
// a coarse step, farther.
void solveMovingIsland(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, double gravity_speed) {
  const double residual = residualOf(rows, tolerance::kSolverCoarseResidual);
  const int careful_sweeps = std::max(shareOfSweeps(rows), tolerance::kSolverSweeps);
  const int most_sweeps = tolerance::kSolverMostVisits / static_cast<int>(rows.size());
  solveContactsFocused(rows, bodies,
                       {.sweeps = std::max(careful_sweeps, most_sweeps),
                        .residual_mps = residual * gravity_speed,
                        .careful_sweeps = careful_sweeps,
                        .coarse_residual_mps = tolerance::kSolverCoarseResidual * gravity_speed});
}

// With friction.
void solveImpulses(LastingContacts& contacts, std::vector<Body>& bodies, double gravity_speed) {
  for (std::size_t i = 0; i + 1 < contacts.island_begin.size(); ++i) {
    const std::size_t count = contacts.island_begin[i + 1] - contacts.island_begin[i];
    const std::span<ContactRow> rows = std::span(contacts.rows).subspan(contacts.island_begin[i], count);
    if (stands(rows, bodies))
      solveStandingIsland(rows, bodies, contacts.bodies, gravity_speed);
    else
      solveMovingIsland(rows, contacts.bodies, gravity_speed);
  }
}

// Sweeps that pass over what is not stirred are cheapest where few paths come into a gap; where most do,
// paths are swept like impulses.
void solveCrowdPaths(std::span<ContactRow> rows, std::span<ImpulseBody> paths, double residual_mps) {
  SolverSettings settings{.sweeps = kFirstPathSweeps, .residual_mps = residual_mps, .friction = false};
  const SolverReport report = solveContacts(rows, paths, settings);
  if (report.residual_mps <= residual_mps) return;
  if (report.visits > kPathsInMotion * static_cast<long>(rows.size())) {
    settings.sweeps = kPathFocusedSweeps;
    solveContactsFocused(rows, paths, settings);
  } else {
    settings.sweeps = kPathSweeps - kFirstPathSweeps;
    settings.resumes = true;
    solveContacts(rows, paths, settings);
  }
}

// Without friction: the bounds on the paths.
void solvePaths(LastingContacts& contacts, double coarse_residual_mps) {
  for (std::size_t i = 0; i + 1 < contacts.island_begin.size(); ++i) {
    const std::size_t count = contacts.island_begin[i + 1] - contacts.island_begin[i];
    const std::span<ContactRow> rows = std::span(contacts.rows).subspan(contacts.island_begin[i], count);
    if (count >= kFocusedRows) {
      solveCrowdPaths(rows, contacts.paths, coarse_residual_mps);
      continue;
    }
    const int careful_sweeps = tolerance::kSolverRowVisits / static_cast<int>(count);
    solveContacts(rows, contacts.paths,
                  {.sweeps = std::max(kPathSweeps, careful_sweeps),
                   .residual_mps = kPathResidual,
                   .friction = false,
                   .careful_sweeps = careful_sweeps,
                   .coarse_residual_mps = coarse_residual_mps});
  }
}

bool givesWay(const ShapePair& pair, const std::vector<Body>& bodies) {
  return bodies[at(pair.body_a)].moves() || bodies[at(pair.body_b)].moves();
}

// The lasting pairs of what moves, as (island, index): those of one island together, so that their rows come
// sorted.
std::vector<std::pair<int, int>> lastingPairs(const std::vector<Body>& bodies,
                                              const std::vector<ShapePair>& pairs, double step_s) {
  Islands islands(static_cast<int>(bodies.size()));
  std::vector<std::pair<int, int>> lasting;  // at first with a body of the island
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ShapePair& pair = pairs[i];
    if (!givesWay(pair, bodies) || !isLasting(pair, step_s)) continue;
    const bool a_moves = bodies[at(pair.body_a)].moves();
    if (a_moves && bodies[at(pair.body_b)].moves()) islands.join(pair.body_a, pair.body_b);
    lasting.emplace_back(a_moves ? pair.body_a : pair.body_b, static_cast<int>(i));
  }
  for (auto& [island, pair] : lasting) island = islands.of(island);
  std::sort(lasting.begin(), lasting.end());
  return lasting;
}

void assemble(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
              std::vector<ShapePair>& pairs, const WorldSettings& settings, StepCounters& counters,
              LastingContacts& contacts) {
  contacts.touched.assign(bodies.size(), 0);
  contacts.bodies.clear();
  contacts.sources.clear();
  for (const Body& body : bodies) {
    ImpulseBody seen = body.impulseBody(body.X_WB, body.velocity);
    if (body.resting) {
      seen.inverse_mass = 0.0;
      seen.inverse_tensor.setZero();
    }
    contacts.bodies.push_back(seen);
  }
  for (const auto& [island, i] : lastingPairs(bodies, pairs, settings.step_s))
    addRows(contacts, i, pairs[at(i)], bodies, shapes, settings, counters);
  for (ShapePair& pair : pairs)
    if (givesWay(pair, bodies)) pair.remembered.clear();  // what a resting pair remembers, it keeps
  sortByIsland(contacts);
}

// The impulse of gravity and of what else surrounds the body over the step.
void giveEnvironment(LastingContacts& contacts, const std::vector<Body>& bodies,
                     const FlightPlanner& planner) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].moves()) continue;
    const Velocity gained = planner.gained(bodies[i]);
    contacts.bodies[i].velocity.linear += gained.linear;
    contacts.bodies[i].velocity.angular += gained.angular;
  }
}

// For the next step's plans: what contacts have given; nothing to bodies in flight, which must not be planned
// as if something held them.
void foreseeContacts(const LastingContacts& contacts, std::vector<Body>& bodies, FlightPlanner& planner) {
  if (planner.isVacuum()) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].moves()) continue;
    if (!contacts.touched[i]) {
      planner.leaveContacts(static_cast<int>(i), bodies[i]);
      continue;
    }
    const Velocity gained = planner.gained(bodies[i]);
    planner.takeContacts(bodies[i],
                         {contacts.bodies[i].velocity.linear - bodies[i].velocity.linear - gained.linear,
                          contacts.bodies[i].velocity.angular - bodies[i].velocity.angular - gained.angular});
  }
}

// Whose paths may bend, one a body.
std::vector<char> findBends(const LastingContacts& contacts, const std::vector<Body>& bodies,
                            const std::vector<ShapePair>& pairs, double step_s) {
  std::vector<char> bends = contacts.touched;
  std::vector<Vec3> accelerations(bodies.size(), Vec3::Zero());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].moves()) accelerations[i] = bodies[i].acceleration;
  for (std::size_t i = 0; i < contacts.sources.size(); ++i)
    straightenDips(contacts.sources[i], pairs[at(contacts.sources[i].pair)].window, step_s, accelerations,
                   bends);
  return bends;
}

// The path of a pressed body: the mean of the velocities before and after, which is exact for constant
// friction, but never into a gap: the same contacts once more, as bounds on the path alone, so that reopening
// a gap gives no energy.
void setPaths(LastingContacts& contacts, std::vector<Body>& bodies, const std::vector<Shape>& shapes,
              const std::vector<ShapePair>& pairs, double step_s, StepCounters& counters) {
  std::vector<ImpulseBody>& paths = contacts.paths;
  paths = contacts.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!contacts.touched[i]) continue;
    paths[i].velocity.linear = 0.5 * (bodies[i].velocity.linear + paths[i].velocity.linear);
    paths[i].velocity.angular = 0.5 * (bodies[i].velocity.angular + paths[i].velocity.angular);
  }
  std::vector<ContactRow>& rows = contacts.rows;
  contacts.momentum.clear();
  double smallest_rest_gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ContactRow& row = rows[i];
    contacts.momentum.push_back({row.impulse, row.lowest_speed});
    const ShapePair& pair = pairs[at(contacts.sources[i].pair)];
    row.lowest_speed = gapSpeeds(contacts.sources[i].gap_m, pair, step_s, row.impulse.x() > 0.0).path;
    row.impulse.setZero();
    smallest_rest_gap = std::min(smallest_rest_gap, pair.window.rest);
  }
  const double coarse_residual = kPathShare * smallest_rest_gap / step_s;
  solvePaths(contacts, coarse_residual);
  for (int round = 0; round < kTurningRounds; ++round) {
    if (!raiseForTurning({bodies, shapes, pairs, 0.0, step_s}, contacts.sources, paths, rows, counters))
      break;
    solvePaths(contacts, coarse_residual);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].impulse = contacts.momentum[i].impulse;
    rows[i].lowest_speed = contacts.momentum[i].lowest_speed;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!contacts.touched[i]) continue;
    bodies[i].travel = Travel::kCarried;
    driveEvenly(bodies[i], {bodies[i].velocity, contacts.bodies[i].velocity, step_s});
  }
  const std::vector<char> bends = findBends(contacts, bodies, pairs, step_s);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (contacts.touched[i]) carryAlong(bodies[i], paths[i].velocity, step_s, bends[i] != 0);
}

void remember(const LastingContacts& contacts, std::vector<ShapePair>& pairs, double step_s) {
  for (std::size_t i = 0; i < contacts.rows.size(); ++i) {
    ShapePair& pair = pairs[at(contacts.sources[i].pair)];
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

}  // namespace

void correctLoad(const SourcedRow& sourced, const RowLoad& load, double step_s,
                 std::vector<ShapePair>& pairs) {
  ShapePair& pair = pairs[at(sourced.pair)];
  // Pairs may have been collected anew since.
  if (pair.body_a != sourced.row.a || pair.body_b != sourced.row.b) return;
  for (RememberedImpulse& remembered : pair.remembered) {
    if (remembered.id != sourced.id) continue;
    remembered.impulse_W = rowImpulse(sourced.row, load.impulse);
    remembered.force_W = remembered.impulse_W / step_s;
    remembered.torque_impulse_W = rowImpulse(sourced.row, load.torque);
    remembered.torque_W = remembered.torque_impulse_W / step_s;
  }
}

void wake(Body& body) {
  body.resting = false;
  body.rest_island = -1;
  body.still_s = 0.0;
}

void wakeIsland(std::vector<Body>& bodies, int island) {
  for (Body& body : bodies)
    if (body.resting && body.rest_island == island) wake(body);
}

bool wakePressed(std::vector<Body>& bodies, const LastingContacts& contacts) {
  bool woken = false;
  for (const ContactRow& row : contacts.rows) {
    if (!(row.impulse.x() > 0.0)) continue;
    for (int i : {row.a, row.b}) {
      if (!bodies[at(i)].resting) continue;
      wakeIsland(bodies, bodies[at(i)].rest_island);
      woken = true;
    }
  }
  return woken;
}

bool isLasting(const ShapePair& pair, double step_s) {
  return pair.closest.distance_m <= lastingHeight(pair, step_s);
}

void solveLastingContacts(std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                          std::vector<ShapePair>& pairs, FlightPlanner& planner,
                          const WorldSettings& settings, StepCounters& counters, LastingContacts& contacts) {
  assemble(bodies, shapes, pairs, settings, counters, contacts);
  giveEnvironment(contacts, bodies, planner);
  for (const ContactRow& row : contacts.rows) applyLoad(row, contacts.bodies);
  solveImpulses(contacts, bodies, settings.gravity.norm() * settings.step_s);
  for (const ContactRow& row : contacts.rows) {
    if (row.impulse.isZero(0.0)) continue;
    contacts.touched[at(row.a)] = contacts.touched[at(row.b)] = 1;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].moves()) contacts.touched[i] = 0;
  foreseeContacts(contacts, bodies, planner);
  setPaths(contacts, bodies, shapes, pairs, settings.step_s, counters);
  remember(contacts, pairs, settings.step_s);
  counters.contact_points = static_cast<int>(contacts.rows.size());
}

}  // namespace carom
