#include "engine/simulation/events/event_loop.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/contacts/carried_path.h"
#include "engine/simulation/events/contact_cluster.h"
#include "engine/simulation/events/step_record.h"

namespace carom {
namespace {

// Rounds in which landings are solved: what the last of them leaves over are events.
constexpr int kLandingRounds = 2;
// How often in one step a body's path is led clear of others with what turning brings back led apart as well.
constexpr int kTurningClearings = 8;
// How often in one step a body's path is led clear of others at all.
constexpr int kMostClearings = 20;
// How often in one step the motion of a body that has been led clear that often is halved; then it is frozen.
constexpr int kMostHalvings = 2;
// Instants of a step: times that differ by rounding are nearly always one.
constexpr double kInstants = 0x1p32;

// The time up to which a pair's gap is proven: there it must be looked at again, if its bodies still travel
// as they did when it was predicted.
struct Event {
  std::int64_t instant = 0;     // its time, as the events are ordered
  bool looked = false;          // then it is an impact or a stop at that time
  double separating_mps = 0.0;  // of the pair at that time, once it is looked
  std::uint64_t rank = 0;       // of the pair
  int pair = -1;                // none: a kinematic body comes to the next piece of its path, before all else
  int version = 0;
  int body = -1;
};

// Of one instant, what approaches fastest comes first: that is the same in a mirror, the order of the pairs
// is not. So all of an instant are looked at before one of them is resolved.
struct Later {
  bool operator()(const Event& x, const Event& y) const {
    return std::tie(x.instant, x.looked, x.separating_mps, x.rank) >
           std::tie(y.instant, y.looked, y.separating_mps, y.rank);
  }
};

class EventLoop {
 public:
  EventLoop(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
            PhaseClock* clock, const StepWatchers& watchers, EventMemory& memory)
      : bodies_(world.bodies),
        shapes_(world.shapes),
        table_(world.table),
        active_(world.active),
        planner_(planner),
        settings_(world.settings),
        crew_(world.crew),
        counters_(counters),
        clock_(clock),
        watchers_(watchers),
        cluster_(bodies_, shapes_, table_, settings_, counters, memory.cluster),
        clearing_(memory.clearing),
        lifts_(memory.lifts),
        predictions_(memory.predictions),
        struck_(memory.struck),
        most_search_work_(std::max(tolerance::kLeastSearchWork,
                                   tolerance::kSearchWorkPerBody * static_cast<long>(bodies_.size()))) {}

  bool run(const LandingSolver& solve_landings) {
    const PhaseScope phase(clock_, StepPhase::kTimeOfImpact);
    clearing_.beginStep();
    for (const int i : struck_) predictions_[at(i)].impacts = 0;
    struck_.clear();
    const std::span<const int> active = active_.list();
    crew_.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        Body& body = bodies_[at(active[k])];
        body.X_end = body.path.at(settings_.step_s);
      }
    });
    lookAtAll();
    if (!holdLandings(solve_landings)) return false;
    for (const int i : table_.active())
      if (predictions_[at(i)].searched) await(i);
    for (const int i : active_.list()) {
      if (!bodies_[at(i)].is_kinematic) continue;
      awaitNextPiece(i);
      countForcesOf(i, 0.0, 1.0);
    }
    // Every event spends budget of a body that still moves, so this ends; and once the search has spent its
    // own, every look clears a pair or freezes a body.
    while (!events_.empty()) {
      const Event event = events_.top();
      events_.pop();
      if (event.pair < 0) {
        beginNextPiece(event.body);
        continue;
      }
      const Prediction& prediction = predictions_[at(event.pair)];
      if (event.version != prediction.version) continue;
      if (event.looked && !hasSpentSearch()) {
        takeUpAllLike(event);
        continue;
      }
      const double time_s = prediction.found.time_s;  // up to here all pairs are proven
      if (!event.looked) look(event.pair);
      if (hasSpentSearch())
        freezePair(event.pair, time_s);
      else
        await(event.pair);
    }
    return true;
  }

 private:
  // The first look at every pair. No event has come yet, so each can be made by itself; most find that the
  // whole step is clear.
  void lookAtAll() {
    predictions_.resize(table_.pairs().size());
    const std::vector<int>& pairs = table_.active();
    crew_.runStretches(pairs.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        predictions_[at(pairs[i])].looked = predictions_[at(pairs[i])].searched = false;
        if (!mayMeet(pairs[i])) continue;
        beginSearch(pairs[i], table_.pairs()[at(pairs[i])].closest);
        carryOn(pairs[i]);
      }
    });
    for (const int i : pairs) {
      const Prediction& prediction = predictions_[at(i)];
      if (!prediction.looked) continue;
      counters_.distance_queries += prediction.found.queries;
      counters_.states_walked += prediction.found.states;
      counters_.newton_steps += prediction.found.newton_steps;
      search_work_ += prediction.found.work;
    }
  }

  // What will not bounce and would come down within the step is held in time where it is many, round by
  // round: what holds one may bring another down. Whether the step goes on.
  bool holdLandings(const LandingSolver& solve_landings) {
    for (int round = 0; round < kLandingRounds && !hasSpentSearch(); ++round) {
      const std::vector<int> landings = foreseeLandings();
      if (landings.empty()) return true;
      const std::optional<std::vector<int>> moved = solve_landings(landings);
      if (!moved) return false;
      if (moved->empty()) return true;
      changed_ = *moved;
      for (const int pair : pairsWithNewPaths(0.0)) begin(pair);
    }
    return true;
  }

  std::vector<int> foreseeLandings() {
    std::vector<int> landings;
    for (const int i : table_.active()) {
      ShapePair& pair = table_.pairs()[at(i)];
      const TimeOfImpact& found = predictions_[at(i)].found;
      if (pair.restitution > 0.0 || !predictions_[at(i)].searched) continue;
      while (found.outcome == TimeOfImpact::Outcome::kPending && !hasSpentSearch()) look(i);
      if (found.outcome == TimeOfImpact::Outcome::kClear ||
          found.outcome == TimeOfImpact::Outcome::kPending || isSlow(i))
        continue;
      // By then it goes another way.
      if (found.time_s > std::min(bodies_[at(pair.body_a)].piece_end_s, bodies_[at(pair.body_b)].piece_end_s))
        continue;
      pair.landing = landingOn(bodies_[at(pair.body_a)].path, bodies_[at(pair.body_b)].path, found);
      landings.push_back(i);
    }
    return landings;
  }

  // Freezes the bodies of a pair that its search has not cleared.
  void freezePair(int index, double time_s) {
    if (predictions_[at(index)].found.outcome == TimeOfImpact::Outcome::kClear) return;
    changed_.clear();
    const ShapePair& pair = table_.pairs()[at(index)];
    for (const int i : {pair.body_a, pair.body_b}) {
      Body& body = bodies_[at(i)];
      if (!body.travels() || body.travel == Travel::kHeld) continue;
      bring(i, time_s);
      hold(i);
      changed_.push_back(i);
    }
    searchAgain(time_s);
  }

  void awaitNextPiece(int index) {
    const Body& body = bodies_[at(index)];
    if (body.piece_end_s < settings_.step_s)
      events_.push({.instant = instantOf(body.piece_end_s), .body = index});
  }

  void beginNextPiece(int index) {
    Body& body = bodies_[at(index)];
    if (body.travel == Travel::kHeld) return;
    const double time_s = body.piece_end_s;
    countForcesOf(index, time_s, -1.0);
    bring(index, time_s);
    planner_.drive(index, body);
    countForcesOf(index, time_s, 1.0);
    changed_.assign(1, index);
    awaitNextPiece(index);
    searchAgain(time_s);
  }

  // What can give way to a kinematic body: it moves, or rests and is woken.
  bool givesWay(int index) const {
    const Body& body = bodies_[at(index)];
    return body.yields() && body.travel != Travel::kHeld;
  }

  // Stops those of the two that are kinematic for the rest of the step.
  void stopDrivenOf(const ShapePair& pair, double time_s) {
    changed_.clear();
    for (const int i : {pair.body_a, pair.body_b}) stopDriven(i, time_s);
    searchAgain(time_s);
  }

  void stopDriven(int index, double time_s) {
    if (bodies_[at(index)].travel != Travel::kDriven) return;
    bring(index, time_s);
    stop(index);
    changed_.push_back(index);
  }

  void stop(int index) {
    Body& body = bodies_[at(index)];
    countForcesOf(index, body.path.start_s, -1.0);
    stopKinematic(body);
    ++counters_.stopped_kinematic;
  }

  // The work of the forces that act between a kinematic body and others from `time_s` on, counted, or taken
  // back where they end (`sign`).
  void countForcesOf(int body, double time_s, double sign) {
    for (const int pair : table_.pairsOf(body))
      counters_.work_J += sign * workOfForces(table_.pairs()[at(pair)], bodies_, time_s, settings_.step_s);
  }

  bool hasSpentSearch() const { return search_work_ > most_search_work_; }

  bool mayMeet(int index) const {
    const ShapePair& pair = table_.pairs()[at(index)];
    return !bodies_[at(pair.body_a)].path.still() || !bodies_[at(pair.body_b)].path.still();
  }

  // The later of its bodies' path starts.
  double beginOf(const ShapePair& pair) const {
    return std::max(bodies_[at(pair.body_a)].path.start_s, bodies_[at(pair.body_b)].path.start_s);
  }

  // Begins the search for a pair's next event, where its bodies' paths do. `at_begin`: its closest features
  // there.
  void beginSearch(int index, const ClosestFeatures& at_begin) {
    Prediction& prediction = predictions_[at(index)];
    const ShapePair& pair = table_.pairs()[at(index)];
    prediction.search = {pair.window,      pair.collision_speed_mps, beginOf(pair),
                         settings_.step_s, pair.restitution == 0.0,  pair.landing.has_value()};
    prediction.found = carom::beginSearch(prediction.search, at_begin);
    prediction.searched = true;
    prediction.looked = false;
  }

  // The search of a pair whose bodies have new paths.
  void begin(int index) {
    predictions_.resize(table_.pairs().size());
    ++predictions_[at(index)].version;
    predictions_[at(index)].searched = false;
    if (mayMeet(index)) beginSearch(index, closestAt(index, beginOf(table_.pairs()[at(index)])));
  }
  void predict(int index) {
    begin(index);
    if (predictions_[at(index)].searched) await(index);
  }

  std::uint64_t rankOf(int index) const { return table_.pairs()[at(index)].rank; }

  std::int64_t instantOf(double time_s) const {
    return static_cast<std::int64_t>(time_s / settings_.step_s * kInstants);
  }

  // What a look has found, in the order of the events.
  void await(int index) {
    const Prediction& prediction = predictions_[at(index)];
    const TimeOfImpact& found = prediction.found;
    if (found.outcome == TimeOfImpact::Outcome::kClear) return;
    const bool pending = found.outcome == TimeOfImpact::Outcome::kPending;
    const double separating = pending ? 0.0 : separatingSpeedAt(index, found);
    events_.push({instantOf(found.time_s), !pending, separating, rankOf(index), index, prediction.version});
  }

  double separatingSpeedAt(int index, const TimeOfImpact& found) const {
    const ShapePair& pair = table_.pairs()[at(index)];
    const auto velocityOf = [&](const Body& body, const Vec3& p_W) {
      const Velocity v{body.path.velocityAt(found.time_s), body.path.angularVelocityAt(found.time_s)};
      return v.at(p_W - body.path.positionAt(found.time_s));
    };
    return dot(found.closest.n_W, velocityOf(bodies_[at(pair.body_b)], found.closest.p_B_W) -
                                      velocityOf(bodies_[at(pair.body_a)], found.closest.p_A_W));
  }

  // Carries the search of a pair on by one look.
  void carryOn(int index) {
    Prediction& prediction = predictions_[at(index)];
    ShapePair& pair = table_.pairs()[at(index)];
    lookFurther(movingPart(pair.shapes.a), movingPart(pair.shapes.b), prediction.search, prediction.found,
                pair.tracked);
    prediction.looked = true;
  }

  void look(int index) {
    const int queries = predictions_[at(index)].found.queries;
    const long states = predictions_[at(index)].found.states;
    const int newton_steps = predictions_[at(index)].found.newton_steps;
    const long work = predictions_[at(index)].found.work;
    carryOn(index);
    search_work_ += predictions_[at(index)].found.work - work;
    counters_.distance_queries += predictions_[at(index)].found.queries - queries;
    counters_.states_walked += predictions_[at(index)].found.states - states;
    counters_.newton_steps += predictions_[at(index)].found.newton_steps - newton_steps;
  }

  // The event and those of its instant and speed: what one of them sets in motion comes after all of them.
  void takeUpAllLike(const Event& first) {
    alike_.assign(1, first);
    while (!events_.empty() && events_.top().instant == first.instant && events_.top().looked &&
           sameApproach(events_.top().separating_mps, first.separating_mps)) {
      alike_.push_back(events_.top());
      events_.pop();
    }
    for (const Event& event : alike_)
      if (event.version == predictions_[at(event.pair)].version) takeUp(event.pair);
  }

  void takeUp(int index) {
    const TimeOfImpact& found = predictions_[at(index)].found;
    const ShapePair& pair = table_.pairs()[at(index)];
    if (!givesWay(pair.body_a) && !givesWay(pair.body_b)) {
      stopDrivenOf(pair, found.time_s);
      return;
    }
    for (const int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].resting && bodies_[at(i == pair.body_a ? pair.body_b : pair.body_a)].is_kinematic)
        wakeInStep(i);
    if (isSlow(index)) {
      clearPaths(index, found);
      return;
    }
    ++counters_.events;
    if (++predictions_[at(index)].impacts == 1) struck_.push_back(index);
    counters_.impacts += found.outcome == TimeOfImpact::Outcome::kImpact;
    resolve(index, found);
  }

  MovingPart movingPart(int shape) const {
    const Shape& s = shapes_[at(shape)];
    return {s.part, &bodies_[at(s.body)].path, s.reach_m, &bodies_[at(s.body)].X_end};
  }

  ClosestFeatures closestAt(int index, double time_s) {
    ShapePair& pair = table_.pairs()[at(index)];
    if (!(time_s > 0.0)) return pair.closest;
    if (const ClosestFeatures* seen = cluster_.closestSeen(index, time_s)) return *seen;
    const ClosestFeatures closest = closestFeatures(
        *shapes_[at(pair.shapes.a)].part, bodies_[at(pair.body_a)].path.at(time_s),
        *shapes_[at(pair.shapes.b)].part, bodies_[at(pair.body_b)].path.at(time_s), pair.tracked);
    counters_.addQuery(closest.states);
    return closest;
  }

  // Whether what a look has found is no collision: paths meet, while the momenta, which impulses act on, do
  // not bring the bodies together fast.
  bool isSlow(int index) const {
    const TimeOfImpact& found = predictions_[at(index)].found;
    const ShapePair& pair = table_.pairs()[at(index)];
    const auto velocityOf = [&](const Body& body, const Vec3& p_W) {
      return body.velocityAt(found.time_s).at(p_W - body.path.positionAt(found.time_s));
    };
    const Vec3 parting = velocityOf(bodies_[at(pair.body_b)], found.closest.p_B_W) -
                         velocityOf(bodies_[at(pair.body_a)], found.closest.p_A_W);
    return dot(found.closest.n_W, parting) >= -slowestImpact(index);
  }

  // What turning brings back again and again lasts: a body that grinds past another would spend thousands of
  // events of a step on impacts of a speed that its turning gives it anew.
  double slowestImpact(int index) const {
    const ShapePair& pair = table_.pairs()[at(index)];
    const Prediction& prediction = predictions_[at(index)];
    if (prediction.impacts <= tolerance::kPairEvents) return pair.collision_speed_mps;
    const double time_s = prediction.found.time_s;
    return std::max(pair.collision_speed_mps,
                    PathClearing::turningSpeed(pair, time_s, settings_.step_s - time_s, bodies_, shapes_));
  }

  // Leads two bodies' paths apart, and with them those that hang together with theirs.
  void clearPaths(int index, const TimeOfImpact& found) {
    const double time_s = found.time_s;
    const double rest = settings_.step_s - time_s;
    const ShapePair& pair = table_.pairs()[at(index)];
    ++counters_.cleared_paths;
    changed_.clear();
    int spent = 0;
    for (const int i : {pair.body_a, pair.body_b}) {
      if (!PathClearing::canBeLed(bodies_[at(i)])) continue;
      changed_.push_back(i);
      spent = std::max(spent, ++bodies_[at(i)].cleared);
    }
    const bool leads = spent <= kMostClearings;
    if (leads) {
      clearing_.add(index, found, rest, spent > kTurningClearings, table_, bodies_);
      clearing_.gather(changed_, time_s, table_, bodies_);
    }
    for (const int i : changed_) bring(i, time_s);
    if (leads) {
      const std::span<const ImpulseBody> paths = clearing_.solve(changed_, time_s, rest, table_, bodies_);
      if (stopWedging(time_s)) return;
      for (std::size_t k = 0; k < changed_.size(); ++k) {
        lead(changed_[k], paths[k].velocity, rest);
        lifts_.join(changed_.front(), changed_[k], bodies_);
      }
    } else if (spent <= kMostClearings + kMostHalvings) {
      for (const int i : changed_) halve(i, rest);
    } else {
      for (const int i : changed_) hold(i);
    }
    searchAgain(time_s);
  }

  // Stops the kinematic bodies that lead the others together; whether there are any.
  bool stopWedging(double time_s) {
    if (clearing_.wedging().empty()) return false;
    const std::size_t others = changed_.size();
    for (const int body : clearing_.wedging()) stopDriven(body, time_s);
    if (changed_.size() == others) return false;
    for (const int body : std::span(changed_).first(others))
      if (bodies_[at(body)].travel == Travel::kBallistic) planner_.plan(body, bodies_[at(body)]);
    searchAgain(time_s);
    return true;
  }

  // Straight on, at this mean velocity.
  void lead(int index, const Velocity& mean, double rest_of_step_s) {
    Body& body = bodies_[at(index)];
    countLift(body, body.path.meanVelocity(body.path.start_s, rest_of_step_s), mean.linear);
    body.travel = Travel::kCarried;
    carryAlong(body, mean, rest_of_step_s, false);
  }

  // From now on the body goes on at another mean velocity than it would have.
  void countLift(Body& body, const Vec3& mean_before, const Vec3& mean) const {
    body.lifting += dot(settings_.gravity, mean_before - mean);
  }

  // The same where it is led in contact: only as far as it falls less or more than its momentum does, and by
  // what of its weight no contact bears. What opens a gap under it lifts it once, and what stops a fall has
  // taken its energy.
  void countFall(Body& body, const Vec3& mean_before, const Vec3& mean) const {
    const Vec3 down = settings_.gravity.normalized();
    const double unborne = std::max(0.0, dot(down, body.acceleration));
    body.lifting += unborne * (std::max(0.0, dot(down, mean_before)) - std::max(0.0, dot(down, mean)));
  }

  void halve(int index, double rest_of_step_s) {
    const Trajectory& path = bodies_[at(index)].path;
    lead(index,
         {0.5 * path.meanVelocity(path.start_s, rest_of_step_s), 0.5 * path.angularVelocityAt(path.start_s)},
         rest_of_step_s);
  }

  // The impulses of one event, the paths that follow, and the searches that these make out of date.
  void resolve(int index, const TimeOfImpact& found) {
    const double time_s = found.time_s;
    const ShapePair& pair = table_.pairs()[at(index)];
    const std::array<int, 2> both{pair.body_a, pair.body_b};
    int spent = 0;
    for (int i : both) {
      if (bodies_[at(i)].resting) wakeInStep(i);
      if (bodies_[at(i)].yields()) spent = std::max(spent, ++bodies_[at(i)].events);
    }
    // Elastic collisions go from body to body as they would (Newton's cradle), but those of one instant and
    // speed are one; the others do not come back, and press at once on all that stands behind.
    const int share = pair.restitution > tolerance::kLively ? tolerance::kLivelyShare : 1;
    const bool crowded = spent > share * tolerance::kPairEvents;
    // What a body that was stopped strikes has perhaps no room behind it.
    const bool spreads = crowded || pair.restitution == 0.0 || bodies_[at(pair.body_a)].was_stopped ||
                         bodies_[at(pair.body_b)].was_stopped;
    {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.begin(index, found.closest, time_s);
      cluster_.collide(spreads);
    }
    counters_.work_J += cluster_.workOfCollision();
    goOn(time_s);
    if (watchers_.view != nullptr) recordCollision(bodies_, cluster_, time_s, *watchers_.view);
    changed_.clear();
    const bool supports = (crowded || spreads || cluster_.meetsCarried()) && time_s < settings_.step_s;
    if (supports) {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.support();
    }
    takeMomentum(time_s, crowded || spreads);
    if (supports) takePaths(time_s, crowded);
    for (std::size_t i = 0; i < cluster_.size(); ++i)
      if (cluster_.member(i).stops) stopDriven(cluster_.member(i).body, time_s);
    const int most =
        cluster_.isExhausted() ? tolerance::kLateEventsPerBody : share * tolerance::kEventsPerBody;
    for (int i : both)
      if (bodies_[at(i)].yields() && bodies_[at(i)].events > most) hold(i);
    searchAgain(time_s);
  }

  // Kinematic bodies that were stopped, and have just moved what was in their way.
  void goOn(double time_s) {
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const int index = cluster_.member(i).body;
      if (!bodies_[at(index)].was_stopped || cluster_.member(i).stops) continue;
      bodies_[at(index)].was_stopped = false;
      countForcesOf(index, time_s, 1.0);
    }
  }

  void wakeInStep(int index) {
    for (const int member : active_.wakeIsland(bodies_, index)) {
      bodies_[at(member)].travel =
          Travel::kCarried;  // held up by others or afloat: its forces are in balance
      table_.activate(member, bodies_, settings_);
    }
  }

  // Brings a body to the time of the event.
  void bring(int index, double time_s) {
    Body& body = bodies_[at(index)];
    if (body.path.start_s == time_s) return;
    counters_.work_J += planner_.workOfLoad(index, body, time_s);
    if (watchers_.paths != nullptr) watchers_.paths->add(at(index), body, time_s);
    const Pose X_WB = body.path.at(time_s);
    body.lift += (time_s - body.path.start_s) * body.lifting;
    body.momentum_velocity = body.velocityAt(time_s, X_WB.rotation);
    body.solved_spin_B += (time_s - body.path.start_s) * body.turning_B;
    body.path.velocity = body.path.velocityAt(time_s);
    body.path.spin += (time_s - body.path.start_s) * body.path.spin_change.rate;
    body.path.X_WB = X_WB;
    body.path.start_s = time_s;
  }

  bool isTouched(std::size_t i) const {
    return i < 2 || cluster_.momentumChanged(i) || cluster_.forcesChanged(i);
  }

  // New momentum and forces, and the path that goes with them; where many meet, straight for who is in
  // flight.
  void takeMomentum(double time_s, bool straight) {
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const ContactCluster::Member& member = cluster_.member(i);
      Body& body = bodies_[at(member.body)];
      if (!body.yields()) continue;
      if (body.resting && isTouched(i)) wakeInStep(member.body);
      body.collided = body.collided || (member.collided && body.moves());
      if (!isTouched(i)) continue;
      const double rest = settings_.step_s - time_s;
      const bool keeps_path = cluster_.keepsPath(i);
      const bool is_as_searched = keeps_path && goesStraight(body);
      bring(member.body, time_s);
      if (!is_as_searched) changed_.push_back(member.body);
      body.momentum_velocity = cluster_.momentum(i);
      if (body.travel == Travel::kHeld) {
        if (rest > 0.0) drive(body, cluster_.end(i), rest);
        // It stays, whatever its new momentum would fall by.
        body.lifting = dot(settings_.gravity, body.momentum_velocity.linear + 0.5 * rest * body.acceleration);
        continue;
      }
      if (keeps_path) {
        keepPath(body, i, rest);
        continue;
      }
      followMomentum(i, rest, straight);
    }
  }

  // The path that its new momentum takes a member of the cluster.
  void followMomentum(std::size_t i, double rest, bool straight) {
    const ContactCluster::Member& member = cluster_.member(i);
    Body& body = bodies_[at(member.body)];
    body.lifting = 0.0;  // its path is that of its momentum again
    const bool flies = body.travel == Travel::kBallistic || member.expanded || !(rest > 0.0);
    if (flies && !cluster_.pressed(i)) {
      body.travel = Travel::kBallistic;
      planner_.plan(member.body, body);
      if (straight && cluster_.size() > 2) straighten(body, rest);
    } else {
      const Velocity& end = cluster_.end(i);
      body.travel = Travel::kCarried;
      drive(body, end, rest);
      carryAlong(body,
                 {0.5 * (body.momentum_velocity.linear + end.linear),
                  0.5 * (body.momentum_velocity.angular + end.angular)},
                 rest, !straight && cluster_.bends(i));
    }
    cluster_.setPath(i, {body.path.velocity + 0.5 * rest * body.path.acceleration, body.path.spin});
  }

  // To `end`, by the tensor of the path's start.
  static void drive(Body& body, const Velocity& end, double rest_of_step_s) {
    const Velocity& begin = body.momentum_velocity;
    driveEvenly(body, {begin,
                       {end.linear - begin.linear, end.angular - begin.angular},
                       body.path.X_WB.rotation,
                       begin.angular,
                       rest_of_step_s});
  }

  static bool goesStraight(const Body& body) {
    return body.travel == Travel::kCarried && body.path.acceleration.isZero(0.0);
  }

  // Straight on to where its path led, with the momentum and the forces that it has now.
  void keepPath(Body& body, std::size_t member, double rest_of_step_s) {
    body.travel = Travel::kCarried;
    drive(body, cluster_.end(member), rest_of_step_s);
    carryAlong(body, cluster_.path(member), rest_of_step_s, false);
  }

  void straighten(Body& body, double rest_of_step_s) {
    body.travel = Travel::kCarried;
    carryAlong(body, {body.path.meanVelocity(body.path.start_s, rest_of_step_s), body.path.spin},
               rest_of_step_s, false);
  }

  void takePaths(double time_s, bool crowded) {
    {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.boundPaths(crowded);
    }
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const int index = cluster_.member(i).body;
      Body& body = bodies_[at(index)];
      if (!body.yields() || body.travel == Travel::kHeld || !cluster_.pathChanged(i)) continue;
      if (body.resting) wakeInStep(index);
      // What was asleep when momenta were taken may be touched now, and was not then.
      if (std::find(changed_.begin(), changed_.end(), index) == changed_.end()) {
        bring(index, time_s);
        changed_.push_back(index);
      }
      body.travel = Travel::kCarried;
      countFall(body, body.path.meanVelocity(time_s, settings_.step_s - time_s), cluster_.path(i).linear);
      carryAlong(body, cluster_.path(i), settings_.step_s - time_s, !crowded && cluster_.bends(i));
      for (const int first : {cluster_.member(0).body, cluster_.member(1).body})
        lifts_.join(first, index, bodies_);
    }
  }

  // Its momentum goes on, and so do the forces of its contacts, which others have the opposites of: they have
  // just been solved together, and the next step solves them again.
  void hold(int index) {
    Body& body = bodies_[at(index)];
    if (body.is_static || body.travel == Travel::kHeld) return;
    if (body.is_kinematic) {
      stop(index);
      return;
    }
    const double start_s = body.path.start_s;
    countLift(body, body.path.meanVelocity(start_s, settings_.step_s - start_s), Vec3::Zero());
    endPath(body);
    ++counters_.stopped_bodies;
  }

  void searchAgain(double time_s) {
    for (const int pair : pairsWithNewPaths(time_s)) predict(pair);
  }

  // The pairs of every body that has a new path.
  std::vector<int> pairsWithNewPaths(double time_s) {
    extendPairs(time_s);
    std::vector<int> pairs;
    for (int body : changed_) {
      bodies_[at(body)].X_end = bodies_[at(body)].path.at(settings_.step_s);
      pairs.insert(pairs.end(), table_.pairsOf(body).begin(), table_.pairsOf(body).end());
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

  void extendPairs(double time_s) {
    const PhaseScope phase(clock_, StepPhase::kBroadPhase);
    for (int body : changed_) table_.extend(body, time_s, bodies_, shapes_, settings_, counters_, clock_);
  }

  std::vector<Body>& bodies_;
  const std::vector<Shape>& shapes_;
  PairTable& table_;
  ActiveBodies& active_;
  const FlightPlanner& planner_;
  const WorldSettings& settings_;
  Crew& crew_;
  StepCounters& counters_;
  PhaseClock* clock_;
  StepWatchers watchers_;
  ContactCluster cluster_;
  PathClearing& clearing_;
  PathLifts& lifts_;
  std::vector<Prediction>& predictions_;  ///< By place of the pair.
  std::vector<int>& struck_;              ///< Pairs that have had impacts in this step.
  long search_work_ = 0;                  ///< Of all searches in this step: see TimeOfImpact::work.
  long most_search_work_ = 0;
  std::vector<int> changed_;  ///< Bodies that the event gave a new path.
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  std::vector<Event> alike_;  ///< Scratch.
};

}  // namespace

bool runEvents(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
               PhaseClock* clock, const StepWatchers& watchers, EventMemory& memory,
               const LandingSolver& solve_landings) {
  return EventLoop(world, planner, counters, clock, watchers, memory).run(solve_landings);
}

}  // namespace carom
