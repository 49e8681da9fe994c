#include "engine/simulation/events/event_loop.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/events/body_paths.h"
#include "engine/simulation/events/contact_cluster.h"
#include "engine/simulation/events/step_record.h"

namespace carom {
namespace {

// Rounds in which landings are solved: what the last of them leaves over are events.
constexpr int kLandingRounds = 2;
// How often in one step a body's path is led clear of others with what turning brings back led apart as well.
constexpr int kTurningClearings = 8;
// How often in one step a body's path is led clear of others at all (decision 0014).
constexpr int kMostClearings = 60;
// How often in one step the motion of a body that has been led clear that often is halved; then it is frozen.
constexpr int kMostHalvings = 2;
// Of a step: times that are no farther apart, one after the other, are one instant; rounding tells mirror
// images apart by less.
constexpr double kInstant = 0x1p-32;

// The time up to which a pair's gap is proven: there it must be looked at again, if its bodies still travel
// as they did when it was predicted.
struct Event {
  double time_s = 0.0;
  bool looked = false;          // then it is an impact or a stop at that time
  double separating_mps = 0.0;  // of the pair at that time, once it is looked
  std::uint64_t rank = 0;       // of the pair
  int pair = -1;                // none: a kinematic body comes to the next piece of its path, before all else
  int version = 0;
  int body = -1;

  bool isCertain() const { return looked || pair < 0; }
};

struct Later {
  bool operator()(const Event& x, const Event& y) const {
    return std::tie(x.time_s, x.rank, x.body) > std::tie(y.time_s, y.rank, y.body);
  }
};

// Of one instant, what approaches fastest comes first: that is the same in a mirror, the order of the pairs
// is not.
struct Slower {
  bool operator()(const Event& x, const Event& y) const {
    return std::make_tuple(x.pair >= 0, x.separating_mps, x.rank, x.body) >
           std::make_tuple(y.pair >= 0, y.separating_mps, y.rank, y.body);
  }
};

template <typename Before>
using EventQueue = std::priority_queue<Event, std::vector<Event>, Before>;

class EventLoop {
 public:
  EventLoop(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
            const StepWatchers& watchers, EventMemory& memory)
      : bodies_(world.bodies),
        shapes_(world.shapes),
        table_(world.table),
        active_(world.active),
        planner_(planner),
        settings_(world.settings),
        crew_(world.crew),
        counters_(counters),
        clock_(watchers.clock),
        watchers_(watchers),
        cluster_(world, planner, counters, memory.cluster),
        paths_(world, planner, counters, watchers.paths),
        searches_(world, cluster_, counters, memory.searches),
        clearing_(memory.clearing),
        lifts_(memory.lifts),
        closed_(memory.closed) {}

  bool run(const LandingSolver& solve_landings) {
    const PhaseScope phase(clock_, StepPhase::kTimeOfImpact);
    clearing_.beginStep();
    const std::span<const int> active = active_.list();
    crew_.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        Body& body = bodies_[at(active[k])];
        body.X_end = body.path.at(settings_.step_s);
      }
    });
    searches_.lookAtAll();
    if (!holdLandings(solve_landings)) return false;
    for (const int i : table_.active())
      if (searches_.of(i).searched) await(i);
    for (const int i : active_.list()) {
      if (!bodies_[at(i)].is_kinematic) continue;
      awaitNextPiece(i);
      paths_.countForcesOf(i, 0.0, 1.0);
    }
    // Every event spends budget of a body that still moves, so this ends; and once the search has spent its
    // own, every look clears a pair or freezes a body.
    while (gatherInstant()) {
      const Event event = instant_.top();
      instant_.pop();
      if (event.pair < 0)
        beginNextPiece(event.body);
      else if (isCurrent(event) && searches_.isSpent())
        freezePair(event.pair, event.time_s);
      else if (isCurrent(event))
        takeUpAllLike(event);
    }
    return true;
  }

 private:
  // All events of an instant are looked at before one of them is resolved; what that brings about at once
  // joins them. Whether there are any more.
  bool gatherInstant() {
    while (!events_.empty()) {
      const Event event = events_.top();
      if (isAfterInstant(event)) break;
      if (isOver(event)) {
        events_.pop();
      } else if (event.isCertain()) {
        events_.pop();
        instant_s_ = instant_.empty() ? event.time_s : std::max(instant_s_, event.time_s);
        instant_.push(event);
      } else {
        lookAtNext();
      }
    }
    return !instant_.empty();
  }

  bool isAfterInstant(const Event& event) const {
    return !instant_.empty() && event.time_s > instant_s_ + kInstant * settings_.step_s;
  }
  bool isOver(const Event& event) const { return event.pair >= 0 && !isCurrent(event); }

  // The pairs that are to be looked at before what comes next for certain, side by side; where nothing can be
  // looked at any more, one after the other.
  void lookAtNext() {
    uncertain_.clear();
    uncertain_pairs_.clear();
    while (!events_.empty()) {
      const Event event = events_.top();
      const bool over = isOver(event);
      if (!over && (event.isCertain() || isAfterInstant(event))) break;
      events_.pop();
      if (over) continue;
      uncertain_.push_back(event);
      uncertain_pairs_.push_back(event.pair);
      if (searches_.isSpent()) break;
    }
    searches_.look(uncertain_pairs_);
    bool is_proven = true;  // up to the event; where bodies froze, their pairs are to be proven from then on
    for (const Event& event : uncertain_) {
      if (!isCurrent(event)) continue;
      if (searches_.isSpent() && is_proven)
        is_proven = !freezePair(event.pair, event.time_s);
      else
        await(event.pair);
    }
  }

  // What will not bounce and would come down within the step is held in time where it is many, round by
  // round: what holds one may bring another down. Whether the step goes on.
  bool holdLandings(const LandingSolver& solve_landings) {
    for (int round = 0; round < kLandingRounds && !searches_.isSpent(); ++round) {
      const std::vector<int> landings = searches_.foreseeLandings();
      if (landings.empty()) return true;
      const std::optional<std::vector<int>> moved = solve_landings(landings);
      if (!moved) return false;
      if (moved->empty()) return true;
      changed_ = *moved;
      for (const int pair : pairsWithNewPaths(0.0)) searches_.begin(pair);
    }
    return true;
  }

  // Freezes the bodies of a pair that its search has not cleared. Whether it has not.
  bool freezePair(int index, double time_s) {
    if (searches_.of(index).found.outcome == TimeOfImpact::Outcome::kClear) return false;
    changed_.clear();
    const ShapePair& pair = table_.pairs()[at(index)];
    for (const int i : {pair.body_a, pair.body_b}) {
      const Body& body = bodies_[at(i)];
      if (!body.travels() || body.travel == Travel::kHeld) continue;
      paths_.bring(i, time_s);
      paths_.hold(i);
      changed_.push_back(i);
    }
    searchAgain(time_s);
    return true;
  }

  void awaitNextPiece(int index) {
    const Body& body = bodies_[at(index)];
    if (body.piece_end_s < settings_.step_s) events_.push({.time_s = body.piece_end_s, .body = index});
  }

  void beginNextPiece(int index) {
    if (bodies_[at(index)].travel == Travel::kHeld) return;
    const double time_s = bodies_[at(index)].piece_end_s;
    paths_.beginNextPiece(index);
    changed_.assign(1, index);
    awaitNextPiece(index);
    pressAnew(index, time_s);
    searchAgain(time_s);
  }

  // The forces of a kinematic body's contacts were found for the piece of its path that has ended.
  void pressAnew(int index, double time_s) {
    const std::span<const int> known = table_.pairsOf(index);
    const std::vector<int> pairs(known.begin(), known.end());
    std::vector<int> pressed{index};
    for (const int p : pairs) {
      const ShapePair& pair = table_.pairs()[at(p)];
      const int other = pair.body_a == index ? pair.body_b : pair.body_a;
      if (!pair.presses() || !givesWay(other) || std::ranges::find(pressed, other) != pressed.end()) continue;
      {
        const PhaseScope phase(clock_, StepPhase::kImpulses);
        cluster_.begin(p, time_s);
        cluster_.support();
      }
      for (std::size_t i = 0; i < cluster_.size(); ++i)
        if (cluster_.member(i).expanded) pressed.push_back(cluster_.member(i).body);
      takeMomentum(time_s, false);
      takePaths(time_s, false);
    }
  }

  // What a kinematic body presses was to go with it until the end of the step; the event has stopped it.
  void pressAnewWhatStops(double time_s) {
    if (time_s >= settings_.step_s) return;
    for (std::size_t k = 0, count = changed_.size(); k < count; ++k) {  // pressAnew adds to them
      const int i = changed_[k];
      if (bodies_[at(i)].is_kinematic && bodies_[at(i)].travel == Travel::kHeld) pressAnew(i, time_s);
    }
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
    if (paths_.stopDriven(index, time_s)) changed_.push_back(index);
  }

  void predict(int index) {
    searches_.begin(index);
    if (searches_.of(index).searched) await(index);
  }

  // What a look has found, in the order of the events.
  void await(int index) {
    const Prediction& prediction = searches_.of(index);
    const TimeOfImpact& found = prediction.found;
    if (found.outcome == TimeOfImpact::Outcome::kClear) return;
    const bool pending = found.outcome == TimeOfImpact::Outcome::kPending;
    const double separating = pending ? 0.0 : searches_.separatingSpeed(index);
    const std::uint64_t rank = table_.pairs()[at(index)].rank;
    events_.push({found.time_s, !pending, separating, rank, index, prediction.version});
  }

  // The event and those of its instant and speed: what one of them sets in motion comes after all of them.
  void takeUpAllLike(const Event& first) {
    alike_.assign(1, first);
    while (!instant_.empty() && sameApproach(instant_.top().separating_mps, first.separating_mps)) {
      alike_.push_back(instant_.top());
      instant_.pop();
    }
    for (std::size_t k = 0; k < alike_.size(); ++k)
      if (isCurrent(alike_[k])) takeUp(alike_[k].pair, std::span<const Event>(alike_).subspan(k + 1));
  }

  bool isCurrent(const Event& event) const { return event.version == searches_.of(event.pair).version; }

  void takeUp(int index, std::span<const Event> alike) {
    const TimeOfImpact& found = searches_.of(index).found;
    const ShapePair& pair = table_.pairs()[at(index)];
    if (!givesWay(pair.body_a) && !givesWay(pair.body_b)) {
      stopDrivenOf(pair, found.time_s);
      return;
    }
    for (const int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].resting && bodies_[at(i == pair.body_a ? pair.body_b : pair.body_a)].is_kinematic)
        wakeInStep(i);
    if (searches_.isSlow(index)) {
      clearPaths(index, found);
      return;
    }
    resolve(index, found, alike);
  }

  // Leads two bodies' paths apart, and with them those that hang together with theirs.
  void clearPaths(int index, const TimeOfImpact& found) {
    const double time_s = found.time_s;
    const double rest = settings_.step_s - time_s;
    const ShapePair& pair = table_.pairs()[at(index)];
    ++counters_.cleared_paths;
    closed_.meet(pair.body_a, pair.body_b, bodies_);
    changed_.clear();
    int spent = 0;
    for (const int i : {pair.body_a, pair.body_b}) {
      if (!PathClearing::canBeLed(bodies_[at(i)])) continue;
      changed_.push_back(i);
      spent = std::max(spent, ++bodies_[at(i)].cleared);
    }
    if (spent <= kMostClearings) {
      clearing_.add(index, found, rest, spent > kTurningClearings, table_, bodies_);
      if (!leadApart(time_s)) return;
    } else {
      for (const int i : changed_) {
        paths_.bring(i, time_s);
        if (spent <= kMostClearings + kMostHalvings)
          paths_.halve(i);
        else
          paths_.hold(i);
      }
      for (const int i : changed_) paths_.findOpening(i);
    }
    searchAgain(time_s);
  }

  // Leads the bodies of the place that was added last, which have changed, and who hangs together with them
  // as far as these must give way. False where kinematic bodies were stopped instead.
  bool leadApart(double time_s) {
    const std::size_t met = changed_.size();
    clearing_.gather(changed_, time_s, bodies_);
    const std::span<const ImpulseBody> paths =
        clearing_.solve(changed_, time_s, settings_.step_s - time_s, bodies_);
    if (stopWedging(time_s)) return false;
    std::size_t led = 0;
    for (std::size_t k = 0; k < changed_.size(); ++k) {
      if (k >= met && !clearing_.isLed(k)) continue;  // its path goes on, with all that is known of it
      const int body = changed_[led++] = changed_[k];
      paths_.bring(body, time_s);
      paths_.lead(body, paths[k].velocity, false);
      lifts_.join(changed_.front(), body, bodies_);
      closed_.meet(changed_.front(), body, bodies_);
    }
    changed_.resize(led);
    for (const int i : changed_) paths_.findOpening(i);
    return true;
  }

  // Stops the kinematic bodies that lead the others together; whether there are any.
  bool stopWedging(double time_s) {
    if (clearing_.wedging().empty()) return false;
    const std::size_t others = changed_.size();
    for (const int body : clearing_.wedging()) stopDriven(body, time_s);
    if (changed_.size() == others) return false;
    for (const int body : std::span(changed_).first(others)) {
      paths_.bring(body, time_s);
      if (bodies_[at(body)].travel == Travel::kBallistic) planner_.plan(body, bodies_[at(body)]);
    }
    searchAgain(time_s);
    return true;
  }

  // Whom the impulses of a pair's event reach.
  struct Reach {
    bool crowded = false;  // its bodies have had many in this step
    bool spreads = false;  // all that they press
  };

  // With this event.
  Reach reachOf(const ShapePair& pair) const {
    int events = 0;
    for (const int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].yields()) events = std::max(events, bodies_[at(i)].events + 1);
    // Elastic collisions go from body to body as they would (Newton's cradle), but those of one instant and
    // speed are one; the others do not come back, and press at once on all that stands behind.
    const bool crowded = events > shareOf(pair) * tolerance::kPairEvents;
    // What a body that was stopped strikes has perhaps no room behind it.
    const bool was_stopped = bodies_[at(pair.body_a)].was_stopped || bodies_[at(pair.body_b)].was_stopped;
    return {crowded, crowded || pair.restitution == 0.0 || was_stopped};
  }

  static int shareOf(const ShapePair& pair) {
    return pair.restitution > tolerance::kNearlyElastic ? tolerance::kNearlyElasticShare : 1;
  }

  // The collision of the event that the cluster has been given.
  void collide(int index, bool spreads) {
    const TimeOfImpact& found = searches_.of(index).found;
    const ShapePair& pair = table_.pairs()[at(index)];
    for (const int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].yields()) ++bodies_[at(i)].events;
    ++counters_.events;
    searches_.strike(index);
    counters_.impacts += found.outcome == TimeOfImpact::Outcome::kImpact;
    {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.collide(spreads);
    }
    counters_.work_J += cluster_.workOfCollision();
    goOn(found.time_s);
    if (watchers_.view != nullptr) recordCollision(bodies_, cluster_, found.time_s, *watchers_.view);
  }

  // Whether an event can be one with that in the cluster: an elastic collision of other bodies.
  bool joins(const Event& event) const {
    const ShapePair& pair = table_.pairs()[at(event.pair)];
    const bool wakes = bodies_[at(pair.body_a)].resting || bodies_[at(pair.body_b)].resting;
    return isCurrent(event) && cluster_.hasRoomFor(pair) && !wakes && !searches_.isSlow(event.pair) &&
           (givesWay(pair.body_a) || givesWay(pair.body_b)) && !reachOf(pair).spreads;
  }

  // The impulses of one event, and of those alike that join it, the paths that follow, and the searches that
  // these make out of date. What stands between those that collide alike is supported once, after all of
  // them, or it would be nearer to the first.
  void resolve(int index, const TimeOfImpact& found, std::span<const Event> alike) {
    const double time_s = found.time_s;
    const ShapePair& pair = table_.pairs()[at(index)];
    for (const int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].resting) wakeInStep(i);
    const auto [crowded, spreads] = reachOf(pair);
    cluster_.begin(index, found.closest, time_s);
    collide(index, spreads);
    for (const Event& event : alike) {
      if (spreads || !joins(event)) continue;
      cluster_.addEvent(event.pair, searches_.of(event.pair).found.closest);
      collide(event.pair, spreads);
    }
    changed_.clear();
    const bool supports = (spreads || cluster_.meetsCarried()) && time_s < settings_.step_s;
    if (supports) {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.support();
    }
    takeMomentum(time_s, spreads);
    if (supports) takePaths(time_s, crowded);
    holdSpent(time_s);
    searchAgain(time_s);
  }

  // What has no room, and who has had the events that a body may have.
  void holdSpent(double time_s) {
    for (std::size_t i = 0; i < cluster_.size(); ++i)
      if (cluster_.member(i).stops) stopDriven(cluster_.member(i).body, time_s);
    for (const int event : cluster_.eventPairs()) {
      const ShapePair& pair = table_.pairs()[at(event)];
      const int most =
          cluster_.isExhausted() ? tolerance::kLateEventsPerBody : shareOf(pair) * tolerance::kEventsPerBody;
      for (const int i : {pair.body_a, pair.body_b})
        if (bodies_[at(i)].yields() && bodies_[at(i)].events > most) paths_.hold(i);
    }
  }

  // Kinematic bodies that were stopped, and have just moved what was in their way.
  void goOn(double time_s) {
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const int index = cluster_.member(i).body;
      if (!bodies_[at(index)].was_stopped || cluster_.member(i).stops) continue;
      bodies_[at(index)].was_stopped = false;
      paths_.countForcesOf(index, time_s, 1.0);
    }
  }

  void wakeInStep(int index) {
    for (const int member : active_.wakeIsland(bodies_, index)) {
      bodies_[at(member)].travel =
          Travel::kCarried;  // held up by others or afloat: its forces are in balance
      table_.activate(member, bodies_, settings_);
      closed_.leaveOpen(member);  // what held it up has no rows in this step
    }
  }

  bool isTouched(std::size_t i) const {
    return cluster_.member(i).struck || cluster_.momentumChanged(i) || cluster_.forcesChanged(i);
  }

  // New momentum and forces, and the path that goes with them; where many meet, straight for who is in
  // flight.
  void takeMomentum(double time_s, bool straight) {
    for (std::size_t i = 1; i < cluster_.size(); ++i)
      closed_.meet(cluster_.member(0).body, cluster_.member(i).body, bodies_);
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const ContactCluster::Member& member = cluster_.member(i);
      Body& body = bodies_[at(member.body)];
      if (!body.yields()) continue;
      if (body.resting && isTouched(i)) wakeInStep(member.body);
      body.collided = body.collided || (member.collided && body.moves());
      if (!isTouched(i)) continue;
      const bool is_as_searched = cluster_.keepsPath(i) && goesStraight(body);
      paths_.bring(member.body, time_s);
      if (!is_as_searched) changed_.push_back(member.body);
      body.momentum_velocity = cluster_.momentum(i);
      if (body.travel == Travel::kHeld)
        paths_.driveHeld(member.body, cluster_.end(i));
      else if (cluster_.keepsPath(i))
        paths_.keepPath(member.body, cluster_.end(i), cluster_.path(i));
      else
        followMomentum(i, settings_.step_s - time_s, straight);
    }
  }

  static bool goesStraight(const Body& body) {
    return body.travel == Travel::kCarried && body.path.acceleration.isZero(0.0);
  }

  // The path that its new momentum takes a member of the cluster.
  void followMomentum(std::size_t i, double rest, bool straight) {
    const ContactCluster::Member& member = cluster_.member(i);
    const Body& body = bodies_[at(member.body)];
    const bool flies = body.travel == Travel::kBallistic || member.expanded || !(rest > 0.0);
    if (!flies || cluster_.pressed(i))
      paths_.carryTo(member.body, cluster_.end(i), !straight && cluster_.bends(i));
    else if (straight && cluster_.size() > 2)
      paths_.flyStraight(member.body);
    else
      paths_.fly(member.body);
    cluster_.setPath(i, {body.path.velocity + 0.5 * rest * body.path.acceleration, body.path.spin});
  }

  void takePaths(double time_s, bool crowded) {
    {
      const PhaseScope phase(clock_, StepPhase::kImpulses);
      cluster_.boundPaths(crowded);
    }
    for (std::size_t i = 0; i < cluster_.size(); ++i) {
      const int index = cluster_.member(i).body;
      const Body& body = bodies_[at(index)];
      if (!body.yields() || body.travel == Travel::kHeld || !cluster_.pathChanged(i)) continue;
      if (body.resting) wakeInStep(index);
      // What was asleep when momenta were taken may be touched now, and was not then.
      if (std::find(changed_.begin(), changed_.end(), index) == changed_.end()) {
        paths_.bring(index, time_s);
        changed_.push_back(index);
      }
      paths_.lead(index, cluster_.path(i), !crowded && cluster_.bends(i));
      for (const int first : {cluster_.member(0).body, cluster_.member(1).body}) {
        lifts_.join(first, index, bodies_);
        closed_.meet(first, index, bodies_);  // it may have joined the cluster for its path alone
      }
    }
    for (const int i : changed_) paths_.findOpening(i);
    for (std::size_t i = 0; i < cluster_.size(); ++i)
      if (cluster_.keepsPath(i) && bodies_[at(cluster_.member(i).body)].yields())
        paths_.findOpening(cluster_.member(i).body);
  }

  void searchAgain(double time_s) {
    pressAnewWhatStops(time_s);
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
    table_.extend(changed_, time_s, {bodies_, shapes_, settings_, crew_}, counters_);
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
  BodyPaths paths_;
  ImpactSearches searches_;
  PathClearing& clearing_;
  PathLifts& lifts_;
  ClosedIslands& closed_;
  std::vector<int> changed_;  ///< Bodies that the event gave a new path.
  EventQueue<Later> events_;
  EventQueue<Slower> instant_;  ///< Those of the present instant, which ends at ...
  double instant_s_ = 0.0;
  // Scratch.
  std::vector<Event> alike_, uncertain_;
  std::vector<int> uncertain_pairs_;
};

}  // namespace

bool runEvents(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
               const StepWatchers& watchers, EventMemory& memory, const LandingSolver& solve_landings) {
  return EventLoop(world, planner, counters, watchers, memory).run(solve_landings);
}

}  // namespace carom
