#include "engine/simulation/event_loop.h"

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>

#include "engine/environment/gravity.h"
#include "engine/response/collision.h"

namespace carom {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr int kPathSweeps = 200;
constexpr double kPathResidual = 1e-9;  // m/s: over a step, far below any gap

struct Event {
  double time_s = 0.0;
  int pair = -1;
  int version = 0;
  TimeOfImpact impact;
};

// The points of contact of an event between bodies 0 and 1, and the gap at each.
struct EventContacts {
  std::vector<ContactRow> rows;
  std::vector<double> gaps_m;
};

struct Later {
  bool operator()(const Event& x, const Event& y) const { return std::tie(x.time_s, x.pair) > std::tie(y.time_s, y.pair); }
};

class EventLoop {
 public:
  EventLoop(std::vector<Body>& bodies, const std::vector<Shape>& shapes, PairTable& table, const WorldSettings& settings,
            StepCounters& counters)
      : bodies_(bodies), shapes_(shapes), table_(table), settings_(settings), counters_(counters) {}

  void run() {
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
    const ImpactSearch search{pair.window, pair.collision_speed_mps, std::max(a.path.start_s, b.path.start_s), settings_.step_s};
    ClosestFeatures closest = pair.closest;
    if (search.begin_s > 0.0) {
      closest = closestFeatures(*shape_a.part, a.path.at(search.begin_s), *shape_b.part, b.path.at(search.begin_s), pair.tracked);
      ++counters_.distance_queries;
    }
    Event event{0.0, index, version,
                timeOfImpact({shape_a.part, &a.path, shape_a.reach_m}, {shape_b.part, &b.path, shape_b.reach_m}, search,
                             closest, pair.tracked)};
    counters_.distance_queries += event.impact.queries;
    if (event.impact.outcome == TimeOfImpact::Outcome::kClear) return;
    event.time_s = event.impact.time_s;
    events_.push(event);
  }

  void resolve(const Event& event) {
    const ShapePair pair = table_.pairs()[at(event.pair)];
    for (int i : {pair.body_a, pair.body_b})
      if (bodies_[at(i)].resting) wakeInStep(i);
    const EventContacts contacts = contactsAt(pair, event);
    for (int i : {pair.body_a, pair.body_b}) restartPath(bodies_[at(i)], event.time_s);
    applyCollision(pair, contacts.rows);
    if (event.impact.outcome == TimeOfImpact::Outcome::kStopped) openGap(pair, event.time_s, contacts);
    for (int i : {pair.body_a, pair.body_b}) spendBudget(bodies_[at(i)]);
    searchAgain(pair, event.time_s);
  }

  void wakeInStep(int index) {
    const int island = bodies_[at(index)].rest_island;
    for (Body& body : bodies_) {
      if (!body.resting || body.rest_island != island) continue;
      wake(body);
      body.travel = Travel::kCarried;  // it lies on others; gravity takes part again from the next step
    }
  }

  // The pair's contact points in the window at the time of the event; at least the closest one.
  EventContacts contactsAt(const ShapePair& pair, const Event& event) const {
    const Body& a = bodies_[at(pair.body_a)];
    const Body& b = bodies_[at(pair.body_b)];
    const Pose X_WA = a.path.at(event.time_s);
    const Pose X_WB = b.path.at(event.time_s);
    const ContactManifold manifold = contactManifold(event.impact.closest, *shapes_[at(pair.shapes.a)].part, X_WA,
                                                     *shapes_[at(pair.shapes.b)].part, X_WB, pair.window);
    double nearest = manifold.points[0].gap_m;
    for (const ManifoldPoint& point : manifold.view()) nearest = std::min(nearest, point.gap_m);
    EventContacts contacts;
    for (const ManifoldPoint& point : manifold.view()) {
      if (point.gap_m > std::max(nearest, pair.window.ceiling)) continue;
      ContactRow row;
      row.a = 0;
      row.b = 1;
      row.n = manifold.n_W;
      row.r_a = point.p_W - X_WA.position;
      row.r_b = point.p_W - X_WB.position;
      row.friction = combinedFriction(a.material, b.material);
      contacts.rows.push_back(row);
      contacts.gaps_m.push_back(point.gap_m);
    }
    return contacts;
  }

  // A path from here on, with the velocity that impulses act on.
  void restartPath(Body& body, double time_s) {
    if (body.is_static) return;
    const Velocity now = body.velocityAt(time_s);
    body.path.X_WB = body.path.at(time_s);
    body.path.start_s = time_s;
    body.momentum_velocity = now;
  }

  void setPathFromMomentum(Body& body) {
    if (body.is_static || body.travel == Travel::kHeld) return;
    body.path.velocity = body.momentum_velocity.linear;
    body.path.spin = body.momentum_velocity.angular;
  }

  void applyCollision(const ShapePair& pair, std::vector<ContactRow> rows) {
    Body& a = bodies_[at(pair.body_a)];
    Body& b = bodies_[at(pair.body_b)];
    std::array<ImpulseBody, 2> colliding{a.impulseBody(a.path.X_WB, a.momentum_velocity), b.impulseBody(b.path.X_WB, b.momentum_velocity)};
    double approach = 0.0;
    for (ContactRow& row : rows) {
      prepareRow(row, colliding);
      approach = std::min(approach, rowVelocity(row, colliding).x());
    }
    if (approach >= 0.0) {
      setPathFromMomentum(a);
      setPathFromMomentum(b);
      return;
    }
    const bool fast = approach < -pair.collision_speed_mps;
    collide(rows, colliding, fast ? combinedRestitution(a.material, b.material) : 0.0);
    a.momentum_velocity = colliding[0].velocity;
    b.momentum_velocity = colliding[1].velocity;
    setPathFromMomentum(a);
    setPathFromMomentum(b);
    a.collided = a.collided || fast;
    b.collided = b.collided || fast;
  }

  // At the floor: the bodies are carried for the rest of the step, on paths that reopen the gap.
  void openGap(const ShapePair& pair, double time_s, const EventContacts& contacts) {
    const double rest_of_step = settings_.step_s - time_s;
    std::array<ImpulseBody, 2> paths;
    for (std::size_t i = 0; i < 2; ++i) {
      Body& body = bodies_[at(i == 0 ? pair.body_a : pair.body_b)];
      if (body.travel == Travel::kBallistic) {
        body.momentum_velocity.linear += gravityImpulsePerMass(settings_.gravity, rest_of_step);
        body.path.acceleration.setZero();
        body.travel = Travel::kCarried;
      }
      paths[i] = body.impulseBody(body.path.X_WB, {body.path.velocity, body.path.spin});
      if (body.travel == Travel::kHeld) {
        paths[i].inverse_mass = 0.0;
        paths[i].inverse_tensor.setZero();
      }
    }
    if (paths[0].inverse_mass == 0.0 && paths[1].inverse_mass == 0.0) return;
    std::vector<ContactRow> rows = contacts.rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].lowest_speed = std::max(0.0, pathSpeed(contacts.gaps_m[i], pair.window, settings_.step_s));
      prepareRow(rows[i], paths);
    }
    solveContacts(rows, paths, {kPathSweeps, kPathResidual, false});
    for (std::size_t i = 0; i < 2; ++i) {
      Body& body = bodies_[at(i == 0 ? pair.body_a : pair.body_b)];
      if (paths[i].inverse_mass == 0.0) continue;
      body.path.velocity = paths[i].velocity.linear;
      body.path.spin = paths[i].velocity.angular;
    }
  }

  void spendBudget(Body& body) {
    if (body.is_static || ++body.events <= tolerance::kEventsPerBody || body.travel == Travel::kHeld) return;
    if (body.travel == Travel::kBallistic)
      body.momentum_velocity.linear += gravityImpulsePerMass(settings_.gravity, settings_.step_s - body.path.start_s);
    body.travel = Travel::kHeld;
    body.path.velocity.setZero();
    body.path.acceleration.setZero();
    body.path.spin.setZero();
    ++counters_.stopped_bodies;
  }

  void searchAgain(const ShapePair& pair, double time_s) {
    for (int body : {pair.body_a, pair.body_b}) {
      if (bodies_[at(body)].is_static) continue;
      table_.extend(body, time_s, settings_.step_s, bodies_, shapes_, settings_.gravity, counters_);
    }
    const std::vector<int> of_a = bodies_[at(pair.body_a)].is_static ? std::vector<int>{} : table_.pairsOf(pair.body_a);
    const std::vector<int> of_b = bodies_[at(pair.body_b)].is_static ? std::vector<int>{} : table_.pairsOf(pair.body_b);
    for (int p : of_a) predict(p);
    for (int p : of_b)
      if (std::find(of_a.begin(), of_a.end(), p) == of_a.end()) predict(p);
  }

  std::vector<Body>& bodies_;
  const std::vector<Shape>& shapes_;
  PairTable& table_;
  const WorldSettings& settings_;
  StepCounters& counters_;
  std::vector<int> versions_;
  std::priority_queue<Event, std::vector<Event>, Later> events_;
};

}  // namespace

void runEvents(std::vector<Body>& bodies, const std::vector<Shape>& shapes, PairTable& table,
               const WorldSettings& settings, StepCounters& counters) {
  EventLoop(bodies, shapes, table, settings, counters).run();
}

}  // namespace carom
