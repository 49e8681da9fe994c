#include "engine/simulation/contacts/pair_table.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "engine/foundation/contract.h"
#include "engine/foundation/index.h"
#include "engine/foundation/visit.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/contacts/contact_rows.h"

namespace carom {
namespace {

constexpr double kLeastGravity = 0.01;          // m/s^2: 6 mm/s for parts a metre wide
constexpr double kShortestBounce = 1.0 / 32.0;  // half a bounce, in steps
constexpr double kNoticedBounce = 1.0;          // steps: a bounce that would last longer is one
constexpr double kFallingShare = 0.5;
constexpr double kStepsOfGravity = 1.5;  // a body on others may fall for a step; half of one is margin

// Of more vertices, the farthest are walked to in less time than all are looked at.
constexpr int kScannedVertices = 16;

// Of a core in the axes of the world, from its origin.
Bounds turnedBounds(const ConvexPolyhedron& core, const Mat3& to_body) {
  Bounds bounds;
  int v = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 direction = to_body.col(axis);
    double& low = bounds.low[axis];
    double& high = bounds.high[axis];
    if (core.vertexCount() <= kScannedVertices) {
      low = high = dot(direction, core.vertex(0));
      for (int i = 1; i < core.vertexCount(); ++i) {
        const double along = dot(direction, core.vertex(i));
        low = std::min(low, along);
        high = std::max(high, along);
      }
    } else {
      v = core.support(direction, v);
      high = dot(direction, core.vertex(v));
      v = core.support(-direction, v);
      low = dot(direction, core.vertex(v));
    }
  }
  return bounds;
}

// The bounds of a part from its body's centre, in the axes of the world.
TurnedBounds turnedBounds(const ConvexPart& part, const Quat& R_WB) {
  const Bounds core = turnedBounds(part.core, R_WB.conjugate().toRotationMatrix());
  return {widened(core, part.radius_m), R_WB};
}

// Everything the part can touch along its path: its bounds at the start moved along the parabola and grown by
// what rotation can do.
Bounds sweptBounds(Bounds bounds, const Shape& shape, const Trajectory& path, double end_s) {
  const double dt = end_s - path.start_s;
  const Vec3 travel = path.positionAt(end_s) - path.X_WB.position;
  const double sag = 0.125 * path.acceleration.norm() * dt * dt;
  const double turn = std::min(path.fastestSpin() * dt, 2.0) * shape.reach_m;
  const double margin = turn + sag;
  bounds.low = bounds.low + travel.cwiseMin(0.0) - Vec3::Constant(margin);
  bounds.high = bounds.high + travel.cwiseMax(0.0) + Vec3::Constant(margin);
  return bounds;
}

// What gravity, or a load, gives a body that falls through the window, or within a step: slower approaches
// are lasting contact. By and by not so where next to nothing is lost in a bounce, which then goes on for
// ever: at e = 1 only bounces shorter than a fraction of a step are left out. Still less between bodies that
// both fall: gravity never brings them together again. A trace of it always remains, or the rounding of a
// finished collision would be taken for another. A bounce that would last longer than a step, 2 e v / g, is
// one, however slow.
double collisionSpeed(const ShapePair& pair, const std::vector<Body>& bodies, double step_s) {
  const auto given = [&](double gravity) {
    return std::max(std::sqrt(2.0 * gravity * pair.window.ceiling), kStepsOfGravity * gravity * step_s);
  };
  const Body &a = bodies[at(pair.body_a)], &b = bodies[at(pair.body_b)];
  const double gravity = std::max(pullBetween(a.pull, b.pull), kLeastGravity);
  const double e = pair.restitution;
  if (e == 0.0) return given(gravity);
  const bool both_fall = !a.supported && !b.supported;
  if (both_fall) return std::max(kFallingShare * (1.0 - e) * given(gravity), given(kLeastGravity));
  const double step_speed = gravity * step_s;
  const double share = std::min((1.0 - e) / (1.0 - tolerance::kLively), 1.0);
  const double noticed = std::min(share * given(gravity), kNoticedBounce * step_speed / (2.0 * e));
  return std::max({noticed, kShortestBounce * step_speed, given(kLeastGravity)});
}

constexpr std::uint64_t kAddedWithinAStep = std::uint64_t{1} << 63;

std::uint64_t rankOf(const IndexPair& shapes) {
  return static_cast<std::uint64_t>(shapes.a) << 32 | static_cast<std::uint64_t>(shapes.b);
}

void scaleRemembered(ShapePair& pair, double factor) {
  for (RememberedImpulse& remembered : pair.remembered) {
    remembered.impulse_W *= factor;
    remembered.torque_impulse_W *= factor;
  }
}

// As the bodies were at the end of the last step.
ClosestFeatures closestNow(const ShapePair& pair, FeaturePair& tracked, const std::vector<Body>& bodies,
                           const std::vector<Shape>& shapes) {
  return closestFeatures(*shapes[at(pair.shapes.a)].part, bodies[at(pair.body_a)].X_WB,
                         *shapes[at(pair.shapes.b)].part, bodies[at(pair.body_b)].X_WB, tracked);
}

// Room for the collision window, and for what contacts may do to the velocity within the step.
double pairingMargin(const Shape& shape) {
  return 2.0 * tolerance::kManifoldHeight * std::min(shape.width_m, tolerance::kWindowLargestScale);
}

// What stays higher on the paths that are planned is hardly brought near by what contacts do to these; where
// it is, bodiesThatMeetOthers says so.
double safeHeight(const ShapePair& pair, const PairedWorld& world) {
  const double margin = std::min(pairingMargin(world.shapes[at(pair.shapes.a)]),
                                 pairingMargin(world.shapes[at(pair.shapes.b)]));
  return pair.contactHeight(world.settings.step_s) + margin;
}

}  // namespace

void PairTable::updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                             std::span<const int> active, double end_s, Crew& crew) {
  if (proxies_.size() != shapes.size()) {
    proxies_.resize(shapes.size());
    starts_.resize(shapes.size());
    turned_bounds_.clear();
    for (const Shape& shape : shapes) turned_bounds_.push_back(turnedBounds(*shape.part, Quat::Identity()));
    of_body_.resize(bodies.size());
    apart_of_body_.resize(bodies.size());
    first_shape_.assign(bodies.size() + 1, 0);
    for (const Shape& shape : shapes) ++first_shape_[at(shape.body) + 1];
    std::partial_sum(first_shape_.begin(), first_shape_.end(), first_shape_.begin());
  }
  active_bodies_.assign(active.begin(), active.end());
  end_s_ = end_s;
  active_shapes_.clear();
  for (const int body : active)
    for (int i = first_shape_[at(body)]; i < first_shape_[at(body) + 1]; ++i) active_shapes_.push_back(i);
  crew.runStretches(active_shapes_.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = at(active_shapes_[k]);
      const Body& body = bodies[at(shapes[i].body)];
      proxies_[i].group = shapes[i].body;
      starts_[i] = boundsAt(active_shapes_[k], body.path.X_WB, shapes);
      const Bounds swept = sweptBounds(starts_[i], shapes[i], body.path, end_s);
      proxies_[i].bounds = widened(swept, pairingMargin(shapes[i]));
      proxies_[i].moves = !body.is_static;  // resting bodies stay paired, so that contacts are remembered
    }
  });
}

// Those that were made for another orientation, and what turning can have added to them: while this is less
// than the margin that the shape is paired with, they are nearly as good as new ones.
Bounds PairTable::boundsAt(int shape, const Pose& X_WB, const std::vector<Shape>& shapes) {
  const Shape& s = shapes[at(shape)];
  TurnedBounds& known = turned_bounds_[at(shape)];
  double turned = s.reach_m * mostTurned(known.R_WB, X_WB.rotation);
  if (turned > pairingMargin(s)) {
    known = turnedBounds(*s.part, X_WB.rotation);
    turned = 0.0;
  }
  Bounds bounds = widened(known.bounds, turned);
  bounds.low += X_WB.position;
  bounds.high += X_WB.position;
  return bounds;
}

ShapePair PairTable::makePair(IndexPair shapes_of_pair, const PairedWorld& world) const {
  const auto& [bodies, shapes, settings, crew] = world;
  ShapePair pair;
  pair.shapes = shapes_of_pair;
  pair.rank = rankOf(shapes_of_pair);
  const Shape& a = shapes[at(shapes_of_pair.a)];
  const Shape& b = shapes[at(shapes_of_pair.b)];
  pair.body_a = a.body;
  pair.body_b = b.body;
  pair.window = collisionWindow(std::min(a.width_m, b.width_m));
  pair.restitution = combinedRestitution(bodies[at(pair.body_a)].material, bodies[at(pair.body_b)].material);
  pair.collision_speed_mps = collisionSpeed(pair, bodies, settings.step_s);
  return pair;
}

// Along that of the world's axes on which the bounds are farthest apart where the paths begin.
SeparatingAxis PairTable::axisOfBounds(const ShapePair& pair, const std::vector<Body>& bodies) const {
  const Bounds &a = starts_[at(pair.shapes.a)], &b = starts_[at(pair.shapes.b)];
  const Vec3 above = b.low - a.high, below = a.low - b.high;
  Eigen::Index axis = 0;
  const double gap = above.cwiseMax(below).maxCoeff(&axis);
  const Vec3 n_W = Vec3::Unit(axis) * (above[axis] >= below[axis] ? 1.0 : -1.0);
  return separatingAxis(n_W, gap, bodies[at(pair.body_a)].X_WB, bodies[at(pair.body_b)].X_WB);
}

// In their place among the near pairs of its bodies, or with those that are apart; nobody asks for those of
// static ones.
void PairTable::enlist(int place, const std::vector<Body>& bodies) {
  ShapePair& pair = pairAt(place);
  for (const bool of_b : {false, true}) {
    const int body = of_b ? pair.body_b : pair.body_a;
    if (bodies[at(body)].is_static) continue;
    if (pair.near) {
      std::vector<int>& known = of_body_[at(body)];
      const auto before = [this](int p, int q) { return isBefore(p, q); };
      known.insert(std::upper_bound(known.begin(), known.end(), place, before), place);
    } else {
      pair.apart_at[of_b ? 1 : 0] = static_cast<int>(apart_of_body_[at(body)].size());
      apart_of_body_[at(body)].push_back(place);
    }
  }
}

// The last of those that are apart takes its place.
void PairTable::unlist(int place, const std::vector<Body>& bodies) {
  const ShapePair& pair = pairAt(place);
  for (const bool of_b : {false, true}) {
    const int body = of_b ? pair.body_b : pair.body_a;
    if (bodies[at(body)].is_static) continue;
    if (pair.near) {
      std::erase(of_body_[at(body)], place);
      continue;
    }
    std::vector<int>& known = apart_of_body_[at(body)];
    const int spot = pair.apart_at[of_b ? 1 : 0];
    ShapePair& last = pairAt(known.back());
    last.apart_at[last.body_b == body ? 1 : 0] = spot;
    known[at(spot)] = known.back();
    known.pop_back();
  }
}

void PairTable::setNear(int place, bool near, const std::vector<Body>& bodies) {
  if (pairAt(place).near == near) return;
  unlist(place, bodies);
  pairAt(place).near = near;
  if (!near) pairAt(place).remembered.clear();
  enlist(place, bodies);
}

int PairTable::add(ShapePair pair, const std::vector<Body>& bodies) {
  if (count() >= kMostPairs) throw TooManyPairs();
  int place = static_cast<int>(pairs_.size());
  if (free_.empty()) {
    pairs_.push_back(std::move(pair));
    landings_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
    pairAt(place) = std::move(pair);
  }
  pairAt(place).active = true;
  enlist(place, bodies);
  return place;
}

void PairTable::remove(int place, const std::vector<Body>& bodies) {
  unlist(place, bodies);
  ShapePair& pair = pairAt(place);
  pair.remembered.clear();
  pair.shapes = {};
  pair.active = false;
  free_.push_back(place);
}

// Pairs without an active body are kept, and looked at no more.
void PairTable::restPairs(const PairedWorld& world, StepCounters& counters) {
  const std::vector<Body>& bodies = world.bodies;
  std::erase_if(active_, [&](int place) {
    ShapePair& pair = pairAt(place);
    if (bodies[at(pair.body_a)].active || bodies[at(pair.body_b)].active) return false;
    if (!pair.near) {
      pair.closest = closestNow(pair, pair.tracked, bodies, world.shapes);
      counters.addQuery(pair.closest.states);
      setNear(place, true, bodies);
    }
    pair.active = false;
    pair.scale = scale_;
    if (resting_gap_m_) resting_gap_m_ = std::min(*resting_gap_m_, pair.closest.distance_m);
    return true;
  });
}

// Pairs added within the last step have the places of their shapes from now on.
void PairTable::takeInExtended(const std::vector<Body>& bodies) {
  const auto before = [this](int p, int q) { return isBefore(p, q); };
  extended_bodies_.clear();
  for (const int place : extended_) {
    ShapePair& pair = pairAt(place);
    pair.rank = rankOf(pair.shapes);
    for (const int body : {pair.body_a, pair.body_b})
      if (!bodies[at(body)].is_static) extended_bodies_.push_back(body);
  }
  std::sort(extended_bodies_.begin(), extended_bodies_.end());
  extended_bodies_.erase(std::unique(extended_bodies_.begin(), extended_bodies_.end()),
                         extended_bodies_.end());
  for (const int body : extended_bodies_)
    std::sort(of_body_[at(body)].begin(), of_body_[at(body)].end(), before);
  extended_.clear();
  if (!std::is_sorted(active_.begin(), active_.end(), before))
    std::sort(active_.begin(), active_.end(), before);
}

template <typename Wanted>
void PairTable::queryWhere(const Wanted& wanted, std::span<const int> places, const PairedWorld& world,
                           StepCounters& counters) {
  world.crew.runStretches(places.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    StepCounters made;
    visit(std::span(pairs_), places.subspan(begin, end - begin), [&](std::size_t, ShapePair& pair) {
      if (!wanted(pair)) return;
      pair.closest = closestNow(pair, pair.tracked, world.bodies, world.shapes);
      made.addQuery(pair.closest.states);
      made.iteration_limits += pair.closest.reached_limit;
    });
    std::atomic_ref(counters.distance_queries) += made.distance_queries;
    std::atomic_ref(counters.states_walked) += made.states_walked;
    std::atomic_ref(counters.iteration_limits) += made.iteration_limits;
  });
}

// Whether what is known of a pair proves that it cannot come near on the paths that are planned.
bool PairTable::willStayApart(ShapePair& pair, bool is_queried, const PairedWorld& world) const {
  if (is_queried) {
    if (pair.closest.distance_m <= pair.contactHeight(world.settings.step_s)) return false;
    pair.apart = separatingAxis(pair.closest.n_W, pair.closest.distance_m, world.bodies[at(pair.body_a)].X_WB,
                                world.bodies[at(pair.body_b)].X_WB);
  }
  return leastGapOf(pair, world.shapes) > safeHeight(pair, world);
}

// Which of the active pairs the step looks at. What was apart is queried only where that is not proven any
// more.
void PairTable::tellApart(const PairedWorld& world, StepCounters& counters, PhaseClock* clock) {
  const auto prove = [&](std::span<const int> places, bool are_queried) {
    stays_apart_.assign(places.size(), 0);
    world.crew.runStretches(places.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      visit(std::span(pairs_), places.subspan(begin, end - begin), [&](std::size_t i, ShapePair& pair) {
        stays_apart_[begin + i] = willStayApart(pair, are_queried || pair.near, world) ? 1 : 0;
      });
    });
  };
  prove(active_, false);
  asked_.clear();
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (stays_apart_[i] != 0)
      setNear(active_[i], false, world.bodies);
    else if (!pairAt(active_[i]).near)
      asked_.push_back(active_[i]);
  }
  {
    const PhaseScope phase(clock, StepPhase::kClosestFeatures);
    queryWhere([](const ShapePair&) { return true; }, asked_, world, counters);
  }
  prove(asked_, true);
  for (std::size_t i = 0; i < asked_.size(); ++i) setNear(asked_[i], stays_apart_[i] == 0, world.bodies);
  near_.clear();
  for (const int place : active_)
    if (pairAt(place).near) near_.push_back(place);
}

void PairTable::collect(const PairedWorld& world, StepCounters& counters, PhaseClock* clock) {
  const std::vector<Body>& bodies = world.bodies;
  boundPaths(bodies, active_bodies_, end_s_);
  const std::vector<IndexPair>& wanted = finder_.find(proxies_, active_bodies_);
  restPairs(world, counters);
  takeInExtended(bodies);
  collected_.clear();
  auto old = active_.begin();
  for (const IndexPair& shapes_of_pair : wanted) {
    for (; old != active_.end() && pairAt(*old).shapes < shapes_of_pair; ++old) remove(*old, bodies);
    if (old != active_.end() && pairAt(*old).shapes == shapes_of_pair) {
      pairAt(*old).collision_speed_mps = collisionSpeed(pairAt(*old), bodies, world.settings.step_s);
      collected_.push_back(*old++);
      continue;
    }
    ShapePair pair = makePair(shapes_of_pair, world);
    pair.apart = axisOfBounds(pair, bodies);
    collected_.push_back(add(std::move(pair), bodies));
  }
  for (; old != active_.end(); ++old) remove(*old, bodies);
  active_.swap(collected_);
  counters.candidate_pairs = static_cast<int>(count());
  counters.active_pairs = static_cast<int>(active_.size());
  tellApart(world, counters, clock);
}

void PairTable::boundPaths(const std::vector<Body>& bodies, std::span<const int> active, double end_s) {
  path_bounds_.resize(bodies.size());
  for (const int i : active) path_bounds_[at(i)] = PathBound(bodies[at(i)].path, 0.0, end_s);
}

double PairTable::leastGapOf(const ShapePair& pair, const std::vector<Shape>& shapes) const {
  return leastGap(pair.apart, path_bounds_[at(pair.body_a)], shapes[at(pair.shapes.a)].reach_m,
                  path_bounds_[at(pair.body_b)], shapes[at(pair.shapes.b)].reach_m);
}

bool PairTable::staysApart(const ShapePair& pair, const PairedWorld& world) const {
  return leastGapOf(pair, world.shapes) > pair.contactHeight(world.settings.step_s);
}

// Makes the bounds of a body's shapes hold its path, and pairs what has grown with what it is not paired
// with.
void PairTable::pairGrown(int body, double time_s, const PairedWorld& world, StepCounters& counters) {
  const Trajectory& path = world.bodies[at(body)].path;
  grown_.clear();
  for (int shape = first_shape_[at(body)]; shape < first_shape_[at(body) + 1]; ++shape) {
    const std::size_t i = at(shape);
    if (time_s > 0.0) starts_[i] = boundsAt(shape, path.X_WB, world.shapes);
    const Bounds swept = sweptBounds(starts_[i], world.shapes[i], path, world.settings.step_s);
    if (proxies_[i].bounds.contains(swept)) continue;
    const Bounds onwards = widened(swept, pairingMargin(world.shapes[i]));
    proxies_[i].bounds.low = proxies_[i].bounds.low.cwiseMin(onwards.low);
    proxies_[i].bounds.high = proxies_[i].bounds.high.cwiseMax(onwards.high);
    finder_.grow(body, onwards);
    grown_.push_back(shape);
  }
  if (grown_.empty()) return;
  finder_.findPartners(proxies_, grown_, partners_);
  known_.clear();
  for (const std::vector<int>* places : {&of_body_[at(body)], &apart_of_body_[at(body)]})
    for (const int place : *places) known_.push_back(pairAt(place).shapes);
  std::sort(known_.begin(), known_.end());
  for (const IndexPair& with : partners_) {
    const IndexPair both{std::min(with.a, with.b), std::max(with.a, with.b)};
    if (std::binary_search(known_.begin(), known_.end(), both)) continue;
    ShapePair pair = makePair(both, world);
    pair.rank = kAddedWithinAStep + extended_.size();
    const int place = add(std::move(pair), world.bodies);
    active_.push_back(place);
    extended_.push_back(place);
    ++counters.candidate_pairs;
    comeNear(place, time_s, world, counters);
  }
}

void PairTable::comeNear(int place, double time_s, const PairedWorld& world, StepCounters& counters) {
  ShapePair& pair = pairAt(place);
  pair.closest = closestFeatures(
      *world.shapes[at(pair.shapes.a)].part, world.bodies[at(pair.body_a)].path.at(time_s),
      *world.shapes[at(pair.shapes.b)].part, world.bodies[at(pair.body_b)].path.at(time_s), pair.tracked);
  counters.addQuery(pair.closest.states);
  setNear(place, true, world.bodies);
  near_.push_back(place);
}

void PairTable::extend(std::span<const int> some, double time_s, const PairedWorld& world,
                       StepCounters& counters) {
  ++extension_;
  extended_in_.resize(world.bodies.size());
  bounded_in_.resize(world.bodies.size());
  const auto boundPath = [&](int body) {
    if (std::exchange(bounded_in_[at(body)], extension_) == extension_) return;
    path_bounds_[at(body)] = PathBound(world.bodies[at(body)].path, time_s, world.settings.step_s);
  };
  for (const int body : some) {
    extended_in_[at(body)] = extension_;
    pairGrown(body, time_s, world, counters);
    boundPath(body);
    asked_.clear();
    for (const int place : apart_of_body_[at(body)]) {
      const ShapePair& pair = pairAt(place);
      const int other = pair.body_a == body ? pair.body_b : pair.body_a;
      if (extended_in_[at(other)] == extension_) continue;  // that was asked already
      boundPath(other);
      if (!staysApart(pair, world)) asked_.push_back(place);
    }
    for (const int place : asked_) comeNear(place, time_s, world, counters);
  }
}

void PairTable::activate(int body, const std::vector<Body>& bodies, const WorldSettings& settings) {
  for (const int place : of_body_[at(body)]) {
    ShapePair& pair = pairAt(place);
    if (pair.active) continue;
    if (resting_gap_m_ && pair.closest.distance_m <= *resting_gap_m_) resting_gap_m_.reset();
    scaleRemembered(pair, impulseScale(pair));
    pair.collision_speed_mps = collisionSpeed(pair, bodies, settings.step_s);
    pair.active = true;
    active_.push_back(place);
    near_.push_back(place);
  }
}

// Powers of two come to the same, whether one by one or together.
void PairTable::scaleImpulses(double factor) {
  for (const int place : active_) scaleRemembered(pairAt(place), factor);
  scale_ *= factor;
}

double PairTable::gapOf(const ShapePair& pair, const std::vector<Body>& bodies,
                        const std::vector<Shape>& shapes) const {
  if (pair.near) return pair.closest.distance_m;
  FeaturePair tracked = pair.tracked;
  return closestNow(pair, tracked, bodies, shapes).distance_m;
}

// What is apart is at least as far as where contacts begin.
double PairTable::smallestGap(const std::vector<Body>& bodies, const std::vector<Shape>& shapes) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!resting_gap_m_) {
    resting_gap_m_ = kInfinity;
    for (const ShapePair& pair : pairs_)
      if (!pair.isFree() && !pair.active) resting_gap_m_ = std::min(*resting_gap_m_, pair.closest.distance_m);
  }
  double smallest = *resting_gap_m_;
  for (const int place : near_) smallest = std::min(smallest, pairAt(place).closest.distance_m);
  for (const int place : active_)
    if (const ShapePair& pair = pairAt(place); !pair.near && pair.window.manifold < smallest)
      smallest = std::min(smallest, gapOf(pair, bodies, shapes));
  return smallest;
}

std::vector<int> PairTable::all() const {
  std::vector<int> places;
  places.reserve(count());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (!pairs_[i].isFree()) places.push_back(static_cast<int>(i));
  std::sort(places.begin(), places.end(), [this](int p, int q) { return isBefore(p, q); });
  return places;
}

std::span<const int> PairTable::bodiesThatMeetOthers(const PairedWorld& world, std::span<const int> active,
                                                     double end_s) {
  const std::vector<Body>& bodies = world.bodies;
  meets_.assign(bodies.size(), 0);
  const auto mark = [&](int body) { std::atomic_ref(meets_[at(body)]).store(1, std::memory_order_relaxed); };
  world.crew.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (const int b : active.subspan(begin, end - begin)) {
      if (!bodies[at(b)].moves()) continue;
      for (std::size_t i = at(first_shape_[at(b)]); i < at(first_shape_[at(b) + 1]); ++i)
        if (!proxies_[i].bounds.contains(sweptBounds(starts_[i], world.shapes[i], bodies[at(b)].path, end_s)))
          mark(b);
    }
  });
  boundPaths(bodies, active, end_s);
  world.crew.runStretches(active_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(active_).subspan(begin, end - begin);
    visit(std::span<const ShapePair>(pairs_), places, [&](std::size_t, const ShapePair& pair) {
      if (pair.near || staysApart(pair, world)) return;
      mark(bodies[at(pair.body_a)].moves() ? pair.body_a : pair.body_b);
    });
  });
  met_.clear();
  for (const int b : active)
    if (meets_[at(b)] != 0) met_.push_back(b);
  return met_;
}

void PairTable::requery(const PairedWorld& world, StepCounters& counters) {
  const auto travels = [&](int body) { return world.bodies[at(body)].travels(); };
  queryWhere([&](const ShapePair& pair) { return travels(pair.body_a) || travels(pair.body_b); }, near_,
             world, counters);
}

}  // namespace carom
