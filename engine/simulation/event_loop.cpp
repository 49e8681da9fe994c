#include "engine/simulation/event_loop.h"

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>

#include "engine/environment/gravity.h"
#include "engine/response/collision.h"

namespace carom {
namespace {

constexpr int kPathSweeps = 200;
constexpr double kPathResidual = 1e-9;  // m/s: over a step, far below any gap
constexpr int kClusterHops = 3;         // how far from the event contacts are solved together

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

struct Event {
  double time_s = 0.0;
  int pair = -1;
  int version = 0;
  TimeOfImpact impact;
};

struct Later {
  bool operator()(const Event& x, const Event& y) const {
    return std::tie(x.time_s, x.pair) > std::tie(y.time_s, y.pair);
  }
};

// Bodies whose impulses are solved together at one instant, and the rows between them.
struct Cluster {
  std::vector<int> members;  ///< Bodies of the world; the solver's list is in the same order.
  std::vector<ImpulseBody> bodies;
  std::vector<SourcedRow> sources;
  std::vector<ContactRow> rows;
  bool opens_gaps = false;  ///< The paths reopen gaps for the rest of the step.
};

class EventLoop {
 public:
  EventLoop(std::vector<Body>& bodies, const std::vector<Shape>& shapes, PairTable& table,
            const WorldSettings& settings, StepCounters& counters, PhaseClock* clock)
      : bodies_(bodies),
        shapes_(shapes),
        table_(table),
        settings_(settings),
        counters_(counters),
        clock_(clock) {}

  void run() {
    const PhaseScope phase(clock_, StepPhase::kTimeOfImpact);
    for (std::size_t i = 0; i < table_.pairs().size(); ++i) predict(static_cast<int>(i));
    while (!events_.empty()) {  // every event spends budget of a body that still moves, so this ends
      const Event event = events_.top();
      events_.pop();
      if (event.version != versions_[at(event.pair)]) continue;
      resolve(event);
      ++counters_.events;
    }
  }

 private:
  // Searches the pair's next event from the later of its bodies' path starts.
  void predict(int index) {
    versions_.resize(table_.pairs().size(), 0);
    const int version = ++versions_[at(index)];
    ShapePair& pair = table_.pairs()[at(index)];
    const Body& a = bodies_[at(pair.body_a)];
    const Body& b = bodies_[at(pair.body_b)];
    if (a.path.still() && b.path.still()) return;
    const Shape& shape_a = shapes_[at(pair.shapes.a)];
    const Shape& shape_b = shapes_[at(pair.shapes.b)];
    const ImpactSearch search{pair.window, pair.collision_speed_mps, std::max(a.path.start_s, b.path.start_s),
                              settings_.step_s};
    const ClosestFeatures closest = search.begin_s > 0.0 ? closestAt(pair, search.begin_s) : pair.closest;
    Event event{0.0, index, version,
                timeOfImpact({shape_a.part, &a.path, shape_a.reach_m},
                             {shape_b.part, &b.path, shape_b.reach_m}, search, closest, pair.tracked)};
    counters_.distance_queries += event.impact.queries;
    if (event.impact.outcome == TimeOfImpact::Outcome::kClear) return;
    event.time_s = event.impact.time_s;
    events_.push(event);
  }

  ClosestFeatures closestAt(ShapePair& pair, double time_s) {
    ++counters_.distance_queries;
    return closestFeatures(*shapes_[at(pair.shapes.a)].part, bodies_[at(pair.body_a)].path.at(time_s),
                           *shapes_[at(pair.shapes.b)].part, bodies_[at(pair.body_b)].path.at(time_s),
                           pair.tracked);
  }

  void resolve(const Event& event) {
    const ShapePair& pair = table_.pairs()[at(event.pair)];
    const std::array<int, 2> both{pair.body_a, pair.body_b};
    int spent = 0;
    for (int i : both) {
      if (bodies_[at(i)].resting) wakeInStep(i);
      if (!bodies_[at(i)].is_static) spent = std::max(spent, ++bodies_[at(i)].events);
    }
    Cluster cluster = spent <= tolerance::kPairEvents ? pairCluster(event) : contactCluster(event);
    cluster.opens_gaps = cluster.opens_gaps || event.impact.outcome == TimeOfImpact::Outcome::kStopped;
    applyCollision(cluster);
    setPaths(cluster, event.time_s);
    for (int i : both)
      if (bodies_[at(i)].events > tolerance::kEventsPerBody) hold(bodies_[at(i)]);
    searchAgain(cluster, event.time_s);
  }

  void wakeInStep(int index) {
    const int island = bodies_[at(index)].rest_island;
    for (Body& body : bodies_) {
      if (!body.resting || body.rest_island != island) continue;
      wake(body);
      body.travel = Travel::kCarried;  // it lies on others; gravity takes part again from the next step
    }
  }

  // The two bodies of the event alone.
  Cluster pairCluster(const Event& event) {
    Cluster cluster;
    const ShapePair& pair = table_.pairs()[at(event.pair)];
    addMember(cluster, pair.body_a, event.time_s);
    addMember(cluster, pair.body_b, event.time_s);
    addPair(cluster, event.pair, event.impact.closest, event.time_s);
    return cluster;
  }

  // The event's bodies and what is in contact with them, over a few hops: two bodies at a time would pass an
  // impulse to and fro between three that touch.
  Cluster contactCluster(const Event& event) {
    Cluster cluster = pairCluster(event);
    cluster.opens_gaps = true;
    std::vector<int> included{event.pair};
    std::size_t begin = 0;
    for (int hop = 0; hop < kClusterHops; ++hop) {
      const std::size_t end = cluster.members.size();
      for (std::size_t m = begin; m < end; ++m) {
        const int body = cluster.members[m];
        if (bodies_[at(body)].is_static) continue;
        for (int p : table_.pairsOf(body)) {
          if (std::find(included.begin(), included.end(), p) != included.end()) continue;
          ShapePair& pair = table_.pairs()[at(p)];
          const ClosestFeatures closest = closestAt(pair, event.time_s);
          if (closest.distance_m > pair.window.ceiling) continue;
          included.push_back(p);
          for (int i : {pair.body_a, pair.body_b}) {
            if (bodies_[at(i)].resting) wakeInStep(i);
            addMember(cluster, i, event.time_s);
          }
          addPair(cluster, p, closest, event.time_s);
        }
      }
      begin = end;
    }
    return cluster;
  }

  // Brings a body to the time of the event, with the velocity that impulses act on.
  void addMember(Cluster& cluster, int index, double time_s) {
    if (std::find(cluster.members.begin(), cluster.members.end(), index) != cluster.members.end()) return;
    Body& body = bodies_[at(index)];
    if (!body.is_static) {
      body.momentum_velocity = body.velocityAt(time_s);
      const Pose X_WB = body.path.at(time_s);
      body.path.velocity = body.path.velocityAt(time_s);
      body.path.X_WB = X_WB;
      body.path.start_s = time_s;
    }
    cluster.members.push_back(index);
    cluster.bodies.push_back(body.impulseBody(body.path.X_WB, body.momentum_velocity));
  }

  void addPair(Cluster& cluster, int index, const ClosestFeatures& closest, double time_s) {
    const ShapePair& pair = table_.pairs()[at(index)];
    const auto local = [&](int body) {
      return static_cast<int>(std::find(cluster.members.begin(), cluster.members.end(), body) -
                              cluster.members.begin());
    };
    std::vector<SourcedRow> rows;
    appendRows({index, local(pair.body_a), local(pair.body_b), &closest,
                bodies_[at(pair.body_a)].path.at(time_s), bodies_[at(pair.body_b)].path.at(time_s)},
               pair, bodies_, shapes_, cluster.bodies, rows);
    for (const SourcedRow& sourced : rows) {
      if (sourced.gap_m > std::max(closest.distance_m, pair.window.ceiling)) continue;
      cluster.sources.push_back(sourced);
      cluster.rows.push_back(sourced.row);
    }
  }

  void applyCollision(Cluster& cluster) {
    const PhaseScope phase(clock_, StepPhase::kImpulses);
    std::vector<double> restitution(cluster.rows.size(), 0.0);
    bool approaches = false;
    for (std::size_t i = 0; i < cluster.rows.size(); ++i) {
      const ShapePair& pair = table_.pairs()[at(cluster.sources[i].pair)];
      const double speed = rowVelocity(cluster.rows[i], cluster.bodies).x();
      approaches = approaches || speed < 0.0;
      if (speed >= -pair.collision_speed_mps) continue;
      Body& a = bodies_[at(pair.body_a)];
      Body& b = bodies_[at(pair.body_b)];
      restitution[i] = combinedRestitution(a.material, b.material);
      a.collided = b.collided = true;
    }
    if (!approaches) return;
    collide(cluster.rows, cluster.bodies, restitution);
    for (std::size_t i = 0; i < cluster.members.size(); ++i)
      if (!bodies_[at(cluster.members[i])].is_static)
        bodies_[at(cluster.members[i])].momentum_velocity = cluster.bodies[i].velocity;
  }

  // New paths with the velocities after the collision. Where gaps are to reopen, gravity is given for the
  // rest of the step and the contacts bound the paths once more.
  void setPaths(const Cluster& cluster, double time_s) {
    const double rest_of_step = settings_.step_s - time_s;
    for (std::size_t i = 0; i < cluster.members.size(); ++i) {
      Body& body = bodies_[at(cluster.members[i])];
      if (body.is_static || body.travel == Travel::kHeld)
        continue;  // held: momentum may change, the path may not
      body.path.velocity = body.momentum_velocity.linear;
      body.path.spin = body.momentum_velocity.angular;
      if (!cluster.opens_gaps || body.travel != Travel::kBallistic) continue;
      body.momentum_velocity.linear += gravityImpulsePerMass(settings_.gravity, rest_of_step);
      body.path.acceleration.setZero();
      body.travel = Travel::kCarried;
    }
    if (cluster.opens_gaps) openGaps(cluster);
  }

  void openGaps(const Cluster& cluster) {
    const PhaseScope phase(clock_, StepPhase::kImpulses);
    std::vector<ImpulseBody> paths = cluster.bodies;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const Body& body = bodies_[at(cluster.members[i])];
      paths[i].velocity = {body.path.velocity, body.path.spin};
      if (body.travel != Travel::kHeld) continue;
      paths[i].inverse_mass = 0.0;
      paths[i].inverse_tensor.setZero();
    }
    std::vector<ContactRow> rows;
    for (std::size_t i = 0; i < cluster.rows.size(); ++i) {
      ContactRow row = cluster.rows[i];
      if (paths[at(row.a)].inverse_mass == 0.0 && paths[at(row.b)].inverse_mass == 0.0) continue;
      const ShapePair& pair = table_.pairs()[at(cluster.sources[i].pair)];
      row.lowest_speed =
          std::max(0.0, gapSpeeds(cluster.sources[i].gap_m, pair.window, settings_.step_s).path);
      row.impulse.setZero();
      prepareRow(row, paths);
      rows.push_back(row);
    }
    solveContacts(rows, paths, {kPathSweeps, kPathResidual, false});
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (paths[i].inverse_mass == 0.0) continue;
      bodies_[at(cluster.members[i])].path.velocity = paths[i].velocity.linear;
      bodies_[at(cluster.members[i])].path.spin = paths[i].velocity.angular;
    }
  }

  // Its momentum stays: the contacts around it have just been solved together, and the next step solves them
  // again.
  void hold(Body& body) {
    if (body.is_static || body.travel == Travel::kHeld) return;
    body.travel = Travel::kHeld;
    body.path.velocity.setZero();
    body.path.acceleration.setZero();
    body.path.spin.setZero();
    ++counters_.stopped_bodies;
  }

  // The pairs of every body that has a new path.
  void searchAgain(const Cluster& cluster, double time_s) {
    std::vector<int> changed;
    extendPairs(cluster, time_s);
    for (int body : cluster.members) {
      if (bodies_[at(body)].is_static) continue;
      changed.insert(changed.end(), table_.pairsOf(body).begin(), table_.pairsOf(body).end());
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (int pair : changed) predict(pair);
  }

  void extendPairs(const Cluster& cluster, double time_s) {
    const PhaseScope phase(clock_, StepPhase::kBroadPhase);
    for (int body : cluster.members) {
      if (bodies_[at(body)].is_static) continue;
      table_.extend(body, time_s, settings_.step_s, bodies_, shapes_, settings_.gravity, counters_, clock_);
    }
  }

  std::vector<Body>& bodies_;
  const std::vector<Shape>& shapes_;
  PairTable& table_;
  const WorldSettings& settings_;
  StepCounters& counters_;
  PhaseClock* clock_;
  std::vector<int> versions_;
  std::priority_queue<Event, std::vector<Event>, Later> events_;
};

}  // namespace

void runEvents(std::vector<Body>& bodies, const std::vector<Shape>& shapes, PairTable& table,
               const WorldSettings& settings, StepCounters& counters, PhaseClock* clock) {
  EventLoop(bodies, shapes, table, settings, counters, clock).run();
}

}  // namespace carom
