#include "engine/simulation/pair_table.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "engine/foundation/contract.h"
#include "engine/simulation/contact_rows.h"

namespace carom {
namespace {

constexpr double kLeastGravity = 0.01;          // m/s^2: 6 mm/s for parts a metre wide
constexpr double kShortestBounce = 1.0 / 32.0;  // half a bounce, in steps
constexpr double kNoticedBounce = 1.0;          // steps: a bounce that would last longer is one
constexpr double kFallingShare = 0.5;
constexpr double kStepsOfGravity = 1.5;  // a body on others may fall for a step; half of one is margin

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// The bounds of a part in a pose.
Bounds boundsAt(const ConvexPart& part, const Pose& X) {
  const Mat3 to_body = X.rotation.conjugate().toRotationMatrix();
  Bounds bounds;
  int v = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 direction = to_body.col(axis);
    v = part.core.support(direction, v);
    bounds.high[axis] = direction.dot(part.core.vertex(v)) + X.position[axis] + part.radius_m;
    v = part.core.support(-direction, v);
    bounds.low[axis] = direction.dot(part.core.vertex(v)) + X.position[axis] - part.radius_m;
  }
  return bounds;
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

// What gravity gives a body that falls through the window, or within a step: slower approaches are lasting
// contact. By and by not so where next to nothing is lost in a bounce, which then goes on for ever: at e = 1
// only bounces shorter than a fraction of a step are left out. Still less between bodies that both fall:
// gravity never brings them together again. A trace of it always remains, or the rounding of a finished
// collision would be taken for another. A bounce that would last longer than a step, 2 e v / g, is one,
// however slow.
double collisionSpeed(const ShapePair& pair, const std::vector<Body>& bodies, const WorldSettings& settings) {
  const auto given = [&](double gravity) {
    return std::max(std::sqrt(2.0 * gravity * pair.window.ceiling),
                    kStepsOfGravity * gravity * settings.step_s);
  };
  const double gravity = std::max(settings.gravity.norm(), kLeastGravity);
  const double e = pair.restitution;
  if (e == 0.0) return given(gravity);
  const bool both_fall = !bodies[at(pair.body_a)].supported && !bodies[at(pair.body_b)].supported;
  if (both_fall) return std::max(kFallingShare * (1.0 - e) * given(gravity), given(kLeastGravity));
  const double step_speed = gravity * settings.step_s;
  const double share = std::min((1.0 - e) / (1.0 - tolerance::kLively), 1.0);
  const double noticed = std::min(share * given(gravity), kNoticedBounce * step_speed / (2.0 * e));
  return std::max({noticed, kShortestBounce * step_speed, given(kLeastGravity)});
}

// Room for the collision window, and for what contacts may do to the velocity within the step.
double pairingMargin(const Shape& shape) {
  return 2.0 * tolerance::kManifoldHeight * std::min(shape.width_m, tolerance::kWindowLargestScale);
}

}  // namespace

void PairTable::updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, double end_s,
                             Crew& crew) {
  const bool first = proxies_.size() != shapes.size();
  proxies_.resize(shapes.size());
  starts_.resize(shapes.size());
  crew.runStretches(shapes.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Body& body = bodies[at(shapes[i].body)];
      proxies_[i].group = shapes[i].body;
      const bool moves = body.moves();
      if (first || moves || proxies_[i].moves) {
        starts_[i] = boundsAt(*shapes[i].part, body.path.X_WB);
        const Bounds swept = sweptBounds(starts_[i], shapes[i], body.path, end_s);
        proxies_[i].bounds = widened(swept, pairingMargin(shapes[i]));
      }
      proxies_[i].moves =
          !body.is_static;  // resting bodies stay paired, so that their contacts are remembered
    }
  });
}

ShapePair PairTable::makePair(IndexPair shapes_of_pair, const std::vector<Body>& bodies,
                              const std::vector<Shape>& shapes, const WorldSettings& settings) const {
  ShapePair pair;
  pair.shapes = shapes_of_pair;
  const Shape& a = shapes[at(shapes_of_pair.a)];
  const Shape& b = shapes[at(shapes_of_pair.b)];
  pair.body_a = a.body;
  pair.body_b = b.body;
  pair.window = collisionWindow(std::min(a.width_m, b.width_m));
  pair.restitution = combinedRestitution(bodies[at(pair.body_a)].material, bodies[at(pair.body_b)].material);
  pair.collision_speed_mps = collisionSpeed(pair, bodies, settings);
  return pair;
}

void PairTable::link(std::size_t pair) {
  of_body_[at(pairs_[pair].body_a)].push_back(static_cast<int>(pair));
  of_body_[at(pairs_[pair].body_b)].push_back(static_cast<int>(pair));
}

void PairTable::collect(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                        const WorldSettings& settings, StepCounters& counters, PhaseClock* clock) {
  std::vector<int> all(proxies_.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<IndexPair>& wanted = finder_.find(proxies_, all);
  counters.candidate_pairs = static_cast<int>(wanted.size());
  // In most steps of what has settled the pairs stay as they are, and they are large.
  const auto is = [](const ShapePair& pair, const IndexPair& shapes_of_pair) {
    return pair.shapes == shapes_of_pair;
  };
  if (std::equal(pairs_.begin(), pairs_.end(), wanted.begin(), wanted.end(), is)) {
    for (ShapePair& pair : pairs_) pair.collision_speed_mps = collisionSpeed(pair, bodies, settings);
    return;
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const ShapePair& p, const ShapePair& q) { return p.shapes < q.shapes; });
  std::vector<ShapePair> fresh;
  fresh.reserve(wanted.size());
  auto old = pairs_.begin();
  for (const IndexPair& shapes_of_pair : wanted) {
    while (old != pairs_.end() && old->shapes < shapes_of_pair) ++old;
    if (old != pairs_.end() && old->shapes == shapes_of_pair) {
      fresh.push_back(std::move(*old));
      fresh.back().collision_speed_mps = collisionSpeed(fresh.back(), bodies, settings);
      ++old;
      continue;
    }
    ShapePair pair = makePair(shapes_of_pair, bodies, shapes, settings);
    const PhaseScope phase(clock, StepPhase::kClosestFeatures);
    pair.closest =
        closestFeatures(*shapes[at(pair.shapes.a)].part, bodies[at(pair.body_a)].X_WB,
                        *shapes[at(pair.shapes.b)].part, bodies[at(pair.body_b)].X_WB, pair.tracked);
    ++counters.distance_queries;
    counters.iteration_limits += pair.closest.reached_limit;
    fresh.push_back(pair);
  }
  pairs_ = std::move(fresh);
  of_body_.assign(bodies.size(), {});
  for (std::size_t i = 0; i < pairs_.size(); ++i) link(i);
}

void PairTable::extend(int body, double time_s, const std::vector<Body>& bodies,
                       const std::vector<Shape>& shapes, const WorldSettings& settings,
                       StepCounters& counters, PhaseClock* clock) {
  const auto first = std::lower_bound(shapes.begin(), shapes.end(), body,
                                      [](const Shape& shape, int b) { return shape.body < b; });
  for (auto i = static_cast<std::size_t>(first - shapes.begin()); i < shapes.size(); ++i) {
    if (shapes[i].body != body) break;
    const Trajectory& path = bodies[at(body)].path;
    starts_[i] = boundsAt(*shapes[i].part, path.X_WB);
    const Bounds swept = sweptBounds(starts_[i], shapes[i], path, settings.step_s);
    if (proxies_[i].bounds.contains(swept)) continue;
    const Bounds onwards = widened(swept, pairingMargin(shapes[i]));
    proxies_[i].bounds.low = proxies_[i].bounds.low.cwiseMin(onwards.low);
    proxies_[i].bounds.high = proxies_[i].bounds.high.cwiseMax(onwards.high);
    const int shape = static_cast<int>(i);
    finder_.grow(shape, onwards);
    finder_.findPartners(proxies_, shape, partners_);
    for (int partner : partners_) {
      const int low = std::min(shape, partner);
      const int high = std::max(shape, partner);
      const std::vector<int>& known = of_body_[at(body)];
      if (std::any_of(known.begin(), known.end(), [&](int p) {
            return pairs_[at(p)].shapes == IndexPair{low, high};
          }))
        continue;
      if (pairs_.size() >= kMostPairs) throw TooManyPairs();
      ShapePair pair = makePair({low, high}, bodies, shapes, settings);
      const PhaseScope phase(clock, StepPhase::kClosestFeatures);
      pair.closest =
          closestFeatures(*shapes[at(low)].part, bodies[at(pair.body_a)].path.at(time_s),
                          *shapes[at(high)].part, bodies[at(pair.body_b)].path.at(time_s), pair.tracked);
      ++counters.distance_queries;
      pairs_.push_back(pair);
      link(pairs_.size() - 1);
      ++counters.candidate_pairs;
    }
  }
}

void PairTable::scaleImpulses(double factor) {
  for (ShapePair& pair : pairs_)
    for (RememberedImpulse& remembered : pair.remembered) {
      remembered.impulse_W *= factor;
      remembered.torque_impulse_W *= factor;
    }
}

bool PairTable::pathsLeaveBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                                 double end_s, Crew& crew) const {
  std::atomic<bool> leave = false;
  crew.runStretches(shapes.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !leave; ++i) {
      const Body& body = bodies[at(shapes[i].body)];
      if (body.moves() && !proxies_[i].bounds.contains(sweptBounds(starts_[i], shapes[i], body.path, end_s)))
        leave = true;
    }
  });
  return leave;
}

void PairTable::requery(const std::vector<Body>& bodies, const std::vector<Shape>& shapes, Crew& crew,
                        StepCounters& counters) {
  crew.runStretches(pairs_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    int queries = 0, limits = 0;
    for (std::size_t i = begin; i < end; ++i) {
      ShapePair& pair = pairs_[i];
      const Body& a = bodies[at(pair.body_a)];
      const Body& b = bodies[at(pair.body_b)];
      if (!a.moves() && !b.moves()) continue;
      pair.closest = closestFeatures(*shapes[at(pair.shapes.a)].part, a.X_WB, *shapes[at(pair.shapes.b)].part,
                                     b.X_WB, pair.tracked);
      ++queries;
      limits += pair.closest.reached_limit;
    }
    std::atomic_ref(counters.distance_queries) += queries;
    std::atomic_ref(counters.iteration_limits) += limits;
  });
}

}  // namespace carom
