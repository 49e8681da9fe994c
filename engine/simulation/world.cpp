#include "engine/simulation/world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"
#include "engine/foundation/tolerances.h"
#include "engine/modes/resting.h"
#include "engine/modes/sliding.h"
#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/bodies/state_hash.h"
#include "engine/simulation/bodies/step_paths.h"
#include "engine/simulation/contacts/lasting_contact.h"
#include "engine/simulation/contacts/pair_table.h"
#include "engine/simulation/events/event_loop.h"
#include "engine/simulation/events/step_record.h"
#include "engine/simulation/resting_islands.h"
#include "engine/simulation/start_poses.h"
#include "engine/simulation/swing_damping.h"
#include "engine/simulation/world_contract.h"

namespace carom {
namespace {

constexpr double kSameLength = 1e-9;  // relative: steps of one length but for rounding

BodyState stateOf(const Body& body) {
  return {body.X_WB, body.velocity.linear, body.velocity.angular, body.mode};
}

}  // namespace

struct World::Impl {
  WorldSettings settings;
  int substeps = 1;       ///< Of the last step.
  WorldSettings substep;  ///< The settings, with the length of one of them.
  std::vector<Solid> solids;
  std::vector<BodyDescription> descriptions;
  std::vector<Body> bodies;
  ActiveBodies active;
  std::vector<Shape> shapes;
  std::vector<BodyState> states;
  std::vector<double>
      potential_J;  ///< Of each body as it was published, where there is neither air nor water.
  PairTable table;
  LastingContacts contacts;  ///< Of the last substep.
  FlightPlanner planner;
  RestingIslands resting_islands;
  EventMemory event_memory;
  Crew crew;
  StepCounters counters;
  StepView* view = nullptr;  ///< Who is told of the step, if anybody.
  StepPaths paths;
  bool keeps_paths = false;
  int step_of_paths = 0;  ///< How many steps had been made when they were kept last; 0: never.
  int steps = 0;
  int dynamic_bodies = 0;
  std::vector<int> kinematic_bodies;
  double work_J = 0.0;  ///< Since the start.
  bool started = false;
  bool finite = true;  ///< All states, after the last substep.

  LastingWorld lastingWorld() { return {bodies, shapes, table, active, substep, crew}; }
  PairedWorld pairedWorld() { return {bodies, shapes, substep, crew}; }
  /// Calls work(index) for every active body, side by side.
  template <typename Work>
  void forActive(const Work& work) {
    const std::span<const int> list = active.list();
    crew.runStretches(list.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) work(at(list[k]));
    });
  }
  void makeShapes();
  void wakeDriven();
  void planSubstep(double begin_s, double length_s, PhaseClock* clock);
  double fineStep(const Body& body) const;
  int substepsWanted();
  void divideStep(int count);
  bool advance(PhaseClock* clock);
  void makeSubstep(double begin_s, PhaseClock* clock);
  void planFlight(PhaseClock* clock);
  void findPairs(PhaseClock* clock);
  void meetFarther(PhaseClock* clock);
  void solveContacts(PhaseClock* clock);
  void endPath(std::size_t index);
  void keepLastPieces();
  void finishStep(PhaseClock* clock);
  void updateModes();
  void accumulateStillness();
  void restIslands();
  void publish();
  double potentialOf(int body) const {
    return !bodies[at(body)].yields() ? 0.0 : planner.potential(body, bodies[at(body)]);
  }
};

// Parts are referred to by address, so shapes are made once no solid is added any more.
void World::Impl::makeShapes() {
  shapes.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Solid& solid = solids[at(descriptions[i].solid)];
    const double width = bodies[i].is_static ? std::numeric_limits<double>::infinity() : solid.width();
    for (const ConvexPart& part : solid.parts())
      shapes.push_back({static_cast<int>(i), &part, part.core.radiusAbout(Vec3::Zero()), width});
  }
}

// Loads as large as a scene may have, on bodies as light, leave what a double holds.
bool isFinite(const Body& body) {
  return body.X_WB.position.allFinite() && body.X_WB.rotation.coeffs().allFinite() &&
         body.velocity.linear.allFinite() && body.velocity.angular.allFinite();
}

// The motion of a body that does not move in the step.
void lieStill(Body& body) {
  static_cast<StepMotion&>(body) = {};
  body.path.X_WB = body.X_WB;
}

// Every active body starts the step as if it were in flight.
void World::Impl::planFlight(PhaseClock* clock) {
  const PhaseScope phase(clock, StepPhase::kForces);
  forActive([&](std::size_t i) {
    Body& body = bodies[i];
    body.events = 0;
    body.cleared = 0;
    body.X_end = body.X_WB;
    if (body.travels())
      planner.planStep(static_cast<int>(i), body);
    else
      lieStill(body);
  });
}

void World::Impl::findPairs(PhaseClock* clock) {
  const PhaseScope phase(clock, StepPhase::kBroadPhase);
  table.updateBounds(bodies, shapes, active.list(), substep.step_s, crew);
  table.collect(pairedWorld(), counters, clock);
}

// Pairs that paths could meet which leave the bounds that bodies were paired by are added, and those that
// were apart looked at again; the others keep their places, which contact rows know them by.
void World::Impl::meetFarther(PhaseClock* clock) {
  const PhaseScope phase(clock, StepPhase::kBroadPhase);
  const std::span<const int> met = table.bodiesThatMeetOthers(pairedWorld(), active.list(), substep.step_s);
  table.extend(met, 0.0, pairedWorld(), counters);
}

void World::Impl::solveContacts(PhaseClock* clock) {
  const PhaseScope phase(clock, StepPhase::kImpulses);
  solveLastingContacts(lastingWorld(), planner, counters, contacts);
}

// The body where its path ends.
void World::Impl::endPath(std::size_t index) {
  Body& body = bodies[index];
  if (body.is_kinematic) {
    planner.endDrive(static_cast<int>(index), body);
    return;
  }
  const Vec3 spin_before = body.velocity.angular;
  const Quat rotation_before = body.X_WB.rotation;
  const bool flew_freely = body.flewFreely();
  body.velocity = body.velocityAt(substep.step_s, body.X_end.rotation);
  countPath(body, body.velocity, body.X_end.position, substep.step_s);
  body.opening_W = 0.0;
  body.X_WB = body.X_end;
  if (body.locks.any()) {
    body.X_WB.rotation = body.locks.turnedFrom(rotation_before, body.X_end.rotation);
    body.velocity = {body.locks.movingPart(body.velocity.linear),
                     body.locks.turningPart(body.velocity.angular)};
  }
  if (!flew_freely || spin_before.isZero(0.0)) {
    body.kept_angular_momentum.reset();
    return;
  }
  if (!body.kept_angular_momentum)
    body.kept_angular_momentum = angularMomentum(body.inertia, rotation_before, spin_before);
  body.velocity.angular =
      body.locks.turningPart(angularVelocity(body.inertia, body.X_WB.rotation, *body.kept_angular_momentum));
}

// How the bodies moved from their last events to the substep's end.
void World::Impl::keepLastPieces() {
  for (const int i : active.list())
    if (bodies[at(i)].travels()) paths.add(at(i), bodies[at(i)], substep.step_s);
}

// The state at the step's end, and the closest features there.
void World::Impl::finishStep(PhaseClock* clock) {
  for (const int i : active.list())
    counters.work_J += planner.countWorkOfLoad(i, bodies[at(i)], substep.step_s);
  for (const LastingContacts::PairRows& of_pair : contacts.pair_rows) {
    const ShapePair& pair = table.pairs()[at(of_pair.pair)];
    event_memory.lifts.join(pair.body_a, pair.body_b, bodies);
    event_memory.closed.meet(pair.body_a, pair.body_b, bodies);
  }
  event_memory.closed.measure(bodies, planner);
  forActive([&](std::size_t i) {
    if (!bodies[i].travels()) return;
    endPath(i);
  });
  finite = std::all_of(active.list().begin(), active.list().end(),
                       [this](int i) { return isFinite(bodies[at(i)]); });
  if (!finite) return;
  event_memory.lifts.pay(bodies, active.list(), table, planner, event_memory.closed);
  event_memory.closed.restore(bodies, planner);
  const PhaseScope phase(clock, StepPhase::kClosestFeatures);
  table.requery(pairedWorld(), counters);
}

void World::Impl::accumulateStillness() {
  for (const int i : active.list()) {
    Body& body = bodies[at(i)];
    if (!body.moves()) continue;
    body.still_s = liesStill(body.velocity, body.radius_m) ? body.still_s + substep.step_s : 0.0;
  }
}

void World::Impl::restIslands() {
  resting_islands.rest({bodies, table, planner, substep, contacts, crew}, active.list(), counters);
}

void World::Impl::updateModes() {
  for (const int active_body : active.list()) {
    const std::size_t i = at(active_body);
    Body& body = bodies[i];
    body.supported = !body.moves() || contacts.touched[i];
    if (body.is_static)
      body.mode = Mode::kStatic;
    else if (body.is_kinematic)
      body.mode = Mode::kKinematic;
    else if (body.resting)
      body.mode = Mode::kResting;
    else if (body.collided)
      body.mode = Mode::kColliding;
    else
      body.mode = body.travel == Travel::kBallistic ? Mode::kFree : Mode::kContact;
  }
  std::vector<char> sliding(contacts.rows.size());
  crew.runStretches(sliding.size(), kFewRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) sliding[i] = slides(contacts.rows[i], contacts.bodies) ? 1 : 0;
  });
  for (std::size_t i = 0; i < sliding.size(); ++i) {
    if (!sliding[i]) continue;
    for (int body : {contacts.rows[i].a, contacts.rows[i].b})
      if (bodies[at(body)].mode == Mode::kContact) bodies[at(body)].mode = Mode::kSliding;
  }
}

// What rests so near to a kinematic body that moves that it could be in its way, or lie on it, moves with it.
void World::Impl::wakeDriven() {
  bool woken = false;
  for (const int i : kinematic_bodies) {
    if (!bodies[at(i)].isDriven()) continue;
    const std::vector<int> places = table.pairsOf(i);
    for (const int place : places) {
      const ShapePair& pair = table.pairs()[at(place)];
      const int other = pair.body_a == i ? pair.body_b : pair.body_a;
      if (!bodies[at(other)].resting || !pair.lasts(substep.step_s)) continue;
      for (const int member : active.wakeIsland(bodies, other)) table.activate(member, bodies, substep);
      woken = true;
    }
  }
  if (woken) planFlight(nullptr);
}

// External forces and candidate pairs, with the closest features that ended the last substep.
void World::Impl::planSubstep(double begin_s, double length_s, PhaseClock* clock) {
  substep.step_s = length_s;
  planner.beginStep(begin_s, length_s);
  for (const int place : table.active()) table.pairs()[at(place)].lands = false;
  planFlight(clock);
  findPairs(clock);
  wakeDriven();
}

// How long a substep may be for a body that is pushed as in the planned step; for ever where nothing pushes
// it.
double World::Impl::fineStep(const Body& body) const {
  const Velocity push = planner.gained(body);
  const double acceleration = (push.linear.norm() + body.radius_m * push.angular.norm()) / settings.step_s;
  return std::sqrt(tolerance::kFineFall * body.radius_m / acceleration);
}

// Lasting contact carries bodies along evenly: what turns meanwhile is met the better the shorter the step
// is. Few pairs cost little; what stands or flies freely gains nothing. Asked when the whole step is planned.
int World::Impl::substepsWanted() {
  // Until it has lain still for as long as what comes to rest: at its apex a body in flight is as slow, and
  // so is one that swings, has just been put down, or is about to tip over.
  const auto stirs = [](const Body& body) {
    return body.moves() && (body.still_s < tolerance::kRestTime || !body.supported);
  };
  const std::span<const int> list = active.list();
  if (std::none_of(list.begin(), list.end(), [&](int i) { return stirs(bodies[at(i)]); })) return 1;
  double length_s = tolerance::kFineStep;
  // Pairs of bodies: what has many parts turns about its contacts as what has one does.
  int awake = 0;
  for (const int place : table.activeBodyPairs()) {
    const BodyPair& pair = table.bodyPairs()[at(place)];
    const Body& a = bodies[at(pair.body_a)];
    const Body& b = bodies[at(pair.body_b)];
    if (pair.candidates() == 0 || (!a.moves() && !b.moves())) continue;
    if (2 * ++awake > tolerance::kFinePairs) return 1;  // a crowd need not be counted
    for (const Body* body : {&a, &b})
      if (stirs(*body)) length_s = std::min(length_s, fineStep(*body));
  }
  if (awake == 0) return 1;
  int wanted = 1;
  while (settings.step_s > wanted * length_s * (1.0 + kSameLength) &&
         2 * wanted * awake <= tolerance::kFinePairs)
    wanted *= 2;
  return wanted;
}

void World::Impl::divideStep(int count) {
  if (count != substeps) table.scaleImpulses(static_cast<double>(substeps) / count);
  substeps = count;
  counters.substeps = count;
}

// Not when what rested has been woken: then the step must be planned anew.
bool World::Impl::advance(PhaseClock* clock) {
  if (wakePressed(lastingWorld(), contacts)) return false;  // each time an island fewer rests
  meetFarther(clock);
  const auto solve_landings = [&](std::span<const int> pairs) -> std::optional<std::vector<int>> {
    const PhaseScope phase(clock, StepPhase::kImpulses);
    const std::vector<int> crowded = crowdedLandings(pairs, lastingWorld(), contacts);
    if (crowded.empty()) return crowded;
    std::vector<int> moved = solveLandings(crowded, lastingWorld(), planner, counters, contacts);
    if (wakePressed(lastingWorld(), contacts)) return std::nullopt;
    return moved;
  };
  const StepWatchers watchers{clock, view, keeps_paths ? &paths : nullptr};
  event_memory.lifts.begin(bodies.size());
  event_memory.closed.begin(bodies.size());
  return runEvents(lastingWorld(), planner, counters, watchers, event_memory,
                   std::ref(solve_landings));  // so that it allocates nothing
}

void World::Impl::makeSubstep(double begin_s, PhaseClock* clock) {
  if (view != nullptr) view->begin_s = begin_s;
  // Impulses of lasting contact; what they press awake takes part in them. Then advance from one time of
  // impact to the next.
  for (solveContacts(clock); !advance(clock); solveContacts(clock)) planFlight(clock);
  if (view != nullptr) recordContacts({bodies, shapes, table, begin_s, substeps}, contacts, *view);
  if (keeps_paths) keepLastPieces();
  finishStep(clock);
  if (!finite) return;

  // Modes.
  const PhaseScope phase(clock, StepPhase::kModes);
  accumulateStillness();
  if (settings.resting_mode) {
    dampSwings(lastingWorld(), contacts, planner, event_memory.closed);
    restIslands();
  }
  updateModes();
}

// What is not active stays as it was published.
void World::Impl::publish() {
  for (const int i : active.list()) {
    states[at(i)] = stateOf(bodies[at(i)]);
    if (planner.isVacuum()) potential_J[at(i)] = potentialOf(i);
  }
}

World::World(const WorldSettings& settings) : impl_(std::make_unique<Impl>()) {
  requireSettings(settings);
  impl_->settings = settings;
  impl_->substep = settings;
  impl_->planner = FlightPlanner(settings);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

int World::addSolid(Solid solid) {
  REQUIRE(!impl_->started);
  impl_->solids.push_back(std::move(solid));
  return static_cast<int>(impl_->solids.size()) - 1;
}

int World::addBody(const BodyDescription& description) {
  REQUIRE(!impl_->started);
  requireDescription(description, impl_->solids.size());
  const Solid& solid = impl_->solids[at(description.solid)];
  Body body;
  body.is_static = description.is_static;
  body.is_kinematic = description.is_kinematic;
  body.supported = !body.yields();
  body.material = description.material;
  body.radius_m = solid.radius();
  BodyDescription kept = description;
  if (kept.mass_kg)
    body.material.density_kgpm3 = kept.material.density_kgpm3 = *kept.mass_kg / solid.volume();
  body.X_WB = description.X_WB;
  body.locks = description.locks;
  if (body.yields()) {
    body.inertia = inertiaOf(body.material.density_kgpm3, solid.volume(), solid.unitInertia());
    if (body.locks.any()) body.inertia = lockedInertia(body.inertia, body.locks, body.X_WB.rotation);
    body.pull = pullOf(description.load, impl_->settings.gravity, body.inertia, body.radius_m);
  }
  body.mode = body.is_static ? Mode::kStatic : body.is_kinematic ? Mode::kKinematic : Mode::kFree;
  if (!body.is_static) body.velocity = {description.linear_velocity, description.angular_velocity};
  std::optional<PrescribedPath> path;
  if (body.is_kinematic) {
    path =
        description.keyframes.empty()
            ? PrescribedPath::steady(description.X_WB, description.linear_velocity,
                                     description.angular_velocity)
            : PrescribedPath::through(description.keyframes, description.interpolation, description.repeats);
    const Trajectory first = path->pieceAt(0.0, 0.0).path;
    body.X_WB = kept.X_WB = first.X_WB;
    body.velocity = {first.velocity, first.spin};
    impl_->kinematic_bodies.push_back(static_cast<int>(impl_->bodies.size()));
  }
  impl_->planner.add(description.load, std::move(path));
  impl_->bodies.push_back(body);
  impl_->descriptions.push_back(kept);
  impl_->states.push_back(stateOf(body));
  const int index = static_cast<int>(impl_->bodies.size()) - 1;
  impl_->potential_J.push_back(impl_->potentialOf(index));
  impl_->active.add(index);
  impl_->dynamic_bodies += body.yields();
  return index;
}

std::vector<Overlap> World::start() {
  Impl& w = *impl_;
  REQUIRE(!w.started);
  w.started = true;
  w.makeShapes();
  std::vector<int> solid_of;
  for (const BodyDescription& description : w.descriptions) solid_of.push_back(description.solid);
  w.planner.begin(w.solids, std::move(solid_of));
  w.planFlight(nullptr);
  w.findPairs(nullptr);
  const StartingBodies start{w.bodies, w.shapes, w.active.list(), w.table, w.settings};
  std::vector<Overlap> overlaps = overlapsAtStart(start);
  if (overlaps.empty() && openTouching(start)) {
    w.planFlight(nullptr);
    w.findPairs(nullptr);
    overlaps = stillTouching(start);
  }
  w.crew = Crew(w.settings.threads);
  w.publish();
  return overlaps;
}

void World::step(PhaseClock* clock) {
  Impl& w = *impl_;
  REQUIRE(w.started && w.finite, w.started, w.finite);
  w.counters = {};
  w.event_memory.searches.work = 0;
  w.active.beginStep(w.bodies);
  w.counters.active_bodies = static_cast<int>(w.active.list().size());
  for (const int i : w.active.list()) w.bodies[at(i)].collided = w.bodies[at(i)].frozen = false;
  w.planSubstep(time(), w.settings.step_s, clock);
  w.divideStep(w.substepsWanted());
  const double length_s = w.settings.step_s / w.substeps;
  if (w.keeps_paths) w.paths.beginStep(w.bodies.size(), w.substeps, length_s);
  for (int k = 0; k < w.substeps && w.finite; ++k) {
    const double begin_s = time() + k * length_s;
    if (w.substeps > 1) w.planSubstep(begin_s, length_s, clock);
    if (w.keeps_paths) w.paths.beginSubstep(k);
    w.makeSubstep(begin_s, clock);
  }
  w.publish();
  w.work_J += w.counters.work_J;
  ++w.steps;
  if (w.keeps_paths) w.step_of_paths = w.steps;
  w.planner.beginStep(time(), w.substep.step_s);
  if (w.view != nullptr) recordPairs({w.bodies, w.shapes, w.table, time()}, *w.view);
}

void World::watch(StepView* view) {
  impl_->view = view;
  if (view == nullptr) return;
  *view = StepView{};
  view->begin_s = time();
  recordPairs({impl_->bodies, impl_->shapes, impl_->table, time()}, *view);
}

void World::keepPaths(bool keep) {
  impl_->keeps_paths = keep;
}

void World::statesWithin(double share, std::vector<BodyState>& states) const {
  const Impl& w = *impl_;
  REQUIRE(share >= 0.0 && share <= 1.0, share);
  REQUIRE(w.steps > 0 && w.step_of_paths == w.steps, w.step_of_paths, w.steps);
  states.resize(w.states.size());
  for (std::size_t i = 0; i < states.size(); ++i)
    states[i] = w.paths.stateAt(i, w.bodies[i].inertia, share, w.states[i]);
}

double World::time() const {
  return impl_->steps * impl_->settings.step_s;
}
int World::stepCount() const {
  return impl_->steps;
}
const WorldSettings& World::settings() const {
  return impl_->settings;
}
std::span<const Solid> World::solids() const {
  return impl_->solids;
}
std::span<const BodyState> World::states() const {
  return impl_->states;
}
std::span<const BodyDescription> World::bodies() const {
  return impl_->descriptions;
}
double World::mass(int body) const {
  const Body& b = impl_->bodies[at(body)];
  return b.yields() ? b.inertia.mass_kg : std::numeric_limits<double>::infinity();
}

Audit World::audit() const {
  const Impl& w = *impl_;
  Audit audit;
  audit.time_s = time();
  audit.last_step = w.counters;
  audit.smallest_gap_m = w.table.smallestGap(w.bodies, w.shapes);
  audit.resting_bodies = w.dynamic_bodies;
  audit.work_J = w.work_J;
  for (const int i : w.active.list()) {  // the others have neither energy of motion nor momentum
    const Body& body = w.bodies[at(i)];
    if (body.is_kinematic) audit.kinematic_late_s = std::max(audit.kinematic_late_s, body.late_s);
    if (!body.yields()) continue;
    const Vec3 momentum = body.inertia.mass_kg * body.velocity.linear;
    audit.kinetic_energy_J += kineticEnergy(body.inertia, body.X_WB.rotation, body.velocity);
    audit.linear_momentum += momentum;
    audit.angular_momentum += body.X_WB.position.cross(momentum) +
                              angularMomentum(body.inertia, body.X_WB.rotation, body.velocity.angular);
    audit.resting_bodies -= !body.resting;
  }
  for (std::size_t i = 0; i < w.bodies.size(); ++i)
    audit.potential_energy_J += w.planner.isVacuum() ? w.potential_J[i] : w.potentialOf(static_cast<int>(i));
  return audit;
}

std::uint64_t World::stateHash() const {
  StateHash hash;
  hash.add(time());
  for (const BodyState& state : impl_->states) {
    hash.add(state.X_WB.position);
    hash.add(state.X_WB.rotation);
    hash.add(state.linear_velocity);
    hash.add(state.angular_velocity);
    hash.add(static_cast<std::uint64_t>(state.mode));
  }
  return hash.value();
}

}  // namespace carom
