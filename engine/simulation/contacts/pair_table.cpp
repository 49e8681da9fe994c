#include "engine/simulation/contacts/pair_table.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "engine/contact/collision_speed.h"
#include "engine/foundation/index.h"
#include "engine/foundation/visit.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/contacts/contact_rows.h"

namespace carom {
namespace {

double collisionSpeedOf(const BodyPair& pair, const std::vector<Body>& bodies, double step_s) {
  const Body &a = bodies[at(pair.body_a)], &b = bodies[at(pair.body_b)];
  return collisionSpeed({.window = pair.window,
                         .restitution = pair.restitution,
                         .pull_mps2 = pullBetween(a.pull, b.pull),
                         .both_fall = !a.supported && !b.supported,
                         .step_s = step_s});
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

}  // namespace

void PairTable::updateBounds(const std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                             std::span<const int> active, double end_s, Crew& crew) {
  if (!bounds_.knows(shapes)) {
    bounds_.begin(bodies.size(), shapes);
    proxies_.resize(bodies.size());
    starts_.resize(bodies.size());
    of_body_.resize(bodies.size());
    pairs_of_body_.resize(bodies.size());
  }
  active_bodies_.assign(active.begin(), active.end());
  end_s_ = end_s;
  bounds_.follow(bodies, shapes, active, crew);
  crew.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const int i = active[k];
      const Body& body = bodies[at(i)];
      starts_[at(i)] = bounds_.ofBody(i, body.path.X_WB);
      const Bounds swept = sweptBounds(starts_[at(i)], bounds_.reach(i), body.path, end_s);
      proxies_[at(i)].bounds = widened(swept, pairingMargin(shapes[at(bounds_.firstShape(i))]));
      proxies_[at(i)].moves = !body.is_static;  // resting bodies stay paired, so that contacts are remembered
    }
  });
}

void PairTable::boundPaths(const std::vector<Body>& bodies, std::span<const int> active, double end_s) {
  path_bounds_.resize(bodies.size());
  for (const int i : active) path_bounds_[at(i)] = PathBound(bodies[at(i)].path, 0.0, end_s);
}

int PairTable::addBodyPair(IndexPair bodies_of_pair, const PairedWorld& world) {
  const auto& [bodies, shapes, settings, crew] = world;
  int place = static_cast<int>(body_pairs_.size());
  if (free_body_pairs_.empty()) {
    body_pairs_.emplace_back();
  } else {
    place = free_body_pairs_.back();
    free_body_pairs_.pop_back();
  }
  BodyPair& pair = bodyPairAt(place);
  pair.body_a = bodies_of_pair.a;
  pair.body_b = bodies_of_pair.b;
  pair.active = true;
  pair.added = false;
  const Shape& a = shapes[at(bounds_.firstShape(pair.body_a))];
  const Shape& b = shapes[at(bounds_.firstShape(pair.body_b))];
  pair.window = collisionWindow(std::min(a.width_m, b.width_m));
  pair.margin_m = std::min(pairingMargin(a), pairingMargin(b));
  pair.restitution = combinedRestitution(bodies[at(pair.body_a)].material, bodies[at(pair.body_b)].material);
  pair.listed = {};
  pair.room = {};
  for (const int body : {pair.body_a, pair.body_b})
    if (!bodies[at(body)].is_static) pairs_of_body_[at(body)].push_back(place);
  return place;
}

void PairTable::removeBodyPair(int place, const std::vector<Body>& bodies) {
  BodyPair& pair = bodyPairAt(place);
  while (!pair.near.empty()) remove(pair.near.back(), bodies);
  pair.apart.clear();
  for (const int body : {pair.body_a, pair.body_b})
    if (!bodies[at(body)].is_static) std::erase(pairs_of_body_[at(body)], place);
  pair.body_a = pair.body_b = -1;
  pair.active = false;
  free_body_pairs_.push_back(place);
}

// Those with an active body are those that are wanted, ascending.
void PairTable::pairBodies(std::span<const IndexPair> wanted, const PairedWorld& world) {
  collected_.clear();
  const auto bodiesOf = [&](int place) {
    return IndexPair{bodyPairAt(place).body_a, bodyPairAt(place).body_b};
  };
  auto old = active_pairs_.begin();
  for (const IndexPair& both : wanted) {
    for (; old != active_pairs_.end() && bodiesOf(*old) < both; ++old) removeBodyPair(*old, world.bodies);
    const bool known = old != active_pairs_.end() && bodiesOf(*old) == both;
    collected_.push_back(known ? *old++ : addBodyPair(both, world));
    BodyPair& pair = bodyPairAt(collected_.back());
    pair.collision_speed_mps = collisionSpeedOf(pair, world.bodies, world.settings.step_s);
  }
  for (; old != active_pairs_.end(); ++old) removeBodyPair(*old, world.bodies);
  active_pairs_.swap(collected_);
}

// In its place among the pairs of its bodies; nobody asks for those of static ones.
void PairTable::add(ShapePair pair, int place, const std::vector<Body>& bodies) {
  pairAt(place) = std::move(pair);
  const ShapePair& added = pairAt(place);
  for (const int body : {added.body_a, added.body_b}) {
    if (bodies[at(body)].is_static) continue;
    std::vector<int>& known = of_body_[at(body)];
    const auto before = [this](int p, int q) { return isBefore(p, q); };
    known.insert(std::upper_bound(known.begin(), known.end(), place, before), place);
  }
  bodyPairAt(added.of_bodies).near.push_back(place);
}

void PairTable::remove(int place, const std::vector<Body>& bodies) {
  ShapePair& pair = pairAt(place);
  for (const int body : {pair.body_a, pair.body_b})
    if (!bodies[at(body)].is_static) std::erase(of_body_[at(body)], place);
  std::erase(bodyPairAt(pair.of_bodies).near, place);
  pair.remembered.clear();
  pair.shapes = {};
  pair.active = false;
  free_.push_back(place);
}

// What was apart is near, and so far from each other. Returns its place; it stays among what is apart.
int PairTable::makeNear(int of_bodies, std::size_t index, const ClosestFeatures& closest,
                        const PairedWorld& world) {
  const BodyPair& both = bodyPairAt(of_bodies);
  const ApartPieces& apart = both.apart[index];
  ShapePair pair;
  static_cast<MeetingTerms&>(pair) = both;
  pair.shapes = apart.shapes;
  pair.rank = both.added ? kAddedWithinAStep + extended_.size() : rankOf(apart.shapes);
  pair.body_a = both.body_a;
  pair.body_b = both.body_b;
  pair.of_bodies = of_bodies;
  pair.active = true;
  pair.tracked = apart.tracked;
  pair.closest = closest;
  int place = static_cast<int>(pairs_.size());
  if (free_.empty()) {
    pairs_.emplace_back();
    landings_.emplace_back();
  } else {
    place = free_.back();
    free_.pop_back();
  }
  add(std::move(pair), place, world.bodies);
  near_.push_back(place);
  return place;
}

// Pairs without an active body are kept, and looked at no more.
void PairTable::restPairs(const PairedWorld& world) {
  const std::vector<Body>& bodies = world.bodies;
  const auto gapsOf = [&](BodyPair& pair) {
    pair.resting_gap_m = kInfinity;
    for (ApartPieces& apart : pair.apart)
      pair.resting_gap_m = std::min(pair.resting_gap_m,
                                    closestNow(apart.shapes, apart.tracked, bodies, world.shapes).distance_m);
    double smallest = pair.resting_gap_m;
    for (const int place : pair.near) smallest = std::min(smallest, pairAt(place).closest.distance_m);
    return smallest;
  };
  std::erase_if(active_pairs_, [&](int place) {
    BodyPair& pair = bodyPairAt(place);
    if (bodies[at(pair.body_a)].active || bodies[at(pair.body_b)].active) return false;
    pair.active = false;
    resting_candidates_ += pair.candidates();
    for (const int near : pair.near) {
      pairAt(near).active = false;
      pairAt(near).scale = scale_;
    }
    const double gap = gapsOf(pair);
    if (resting_gap_m_) resting_gap_m_ = std::min(*resting_gap_m_, gap);
    return true;
  });
  std::erase_if(near_, [&](int place) { return !pairAt(place).active; });
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
  const auto lower = [this](int p, int q) {
    const BodyPair &x = bodyPairAt(p), &y = bodyPairAt(q);
    return std::tie(x.body_a, x.body_b) < std::tie(y.body_a, y.body_b);
  };
  if (!std::is_sorted(active_pairs_.begin(), active_pairs_.end(), lower))
    std::sort(active_pairs_.begin(), active_pairs_.end(), lower);
  for (const int place : active_pairs_) bodyPairAt(place).added = false;
}

void PairTable::countCandidates(StepCounters& counters) {
  listed_ = 0;
  for (const int place : active_pairs_) listed_ += bodyPairAt(place).candidates();
  if (listed_ + resting_candidates_ > kMostPairs) throw TooManyPairs();
  counters.candidate_pairs = static_cast<int>(listed_ + resting_candidates_);
  counters.active_pairs = static_cast<int>(listed_);
}

void PairTable::collect(const PairedWorld& world, StepCounters& counters, PhaseClock* clock) {
  boundPaths(world.bodies, active_bodies_, end_s_);
  const std::vector<IndexPair>& wanted = finder_.find(proxies_, active_bodies_);
  restPairs(world);
  takeInExtended(world.bodies);
  pairBodies(wanted, world);
  std::erase_if(near_, [&](int place) { return !pairAt(place).active; });
  tellApart(world);
  lookAtAll(world);
  askApart(world, counters, clock);
  countCandidates(counters);
  const auto before = [this](int p, int q) { return isBefore(p, q); };
  if (!std::is_sorted(near_.begin(), near_.end(), before)) std::sort(near_.begin(), near_.end(), before);
}

// Makes the bounds of a body hold its path, and pairs it with what these have grown to.
void PairTable::pairGrown(int body, double time_s, const PairedWorld& world) {
  const Trajectory& path = world.bodies[at(body)].path;
  if (time_s > 0.0) {
    const std::array<int, 1> one{body};
    Crew alone;
    bounds_.follow(world.bodies, world.shapes, one, alone);
    starts_[at(body)] = bounds_.ofBody(body, path.X_WB);
  }
  const Bounds swept = sweptBounds(starts_[at(body)], bounds_.reach(body), path, world.settings.step_s);
  Proxy& proxy = proxies_[at(body)];
  if (proxy.bounds.contains(swept)) return;
  const Bounds onwards = widened(swept, pairingMargin(world.shapes[at(bounds_.firstShape(body))]));
  proxy.bounds = together(proxy.bounds, onwards);
  finder_.grow(body, onwards);
  finder_.findPartners(proxies_, body, partners_);
  paired_.clear();
  for (const int place : pairs_of_body_[at(body)]) paired_.push_back(bodyPairAt(place).other(body));
  std::sort(paired_.begin(), paired_.end());
  for (const int other : partners_) {
    if (std::binary_search(paired_.begin(), paired_.end(), other)) continue;
    const int place = addBodyPair({std::min(body, other), std::max(body, other)}, world);
    BodyPair& added = bodyPairAt(place);
    added.added = true;
    added.collision_speed_mps = collisionSpeedOf(added, world.bodies, world.settings.step_s);
    active_pairs_.push_back(place);
  }
}

// What is apart of two bodies and could come near on their paths is near.
void PairTable::comeNear(int of_bodies, double time_s, const PairedWorld& world, StepCounters& counters) {
  BodyPair& pair = bodyPairAt(of_bodies);
  const double height = pair.contactHeight(world.settings.step_s);
  if (!staysListed(pair, height)) {
    const std::size_t before = pair.candidates();
    list(pair, true, world, scratch_);
    counters.candidate_pairs += static_cast<int>(pair.candidates() - before);
    if (counters.candidate_pairs > static_cast<int>(kMostPairs)) throw TooManyPairs();
    lookAt(pair, height, world);
  }
  if (!pair.to_measure) return;
  for (std::size_t i = 0; i < pair.apart.size(); ++i) {
    ApartPieces& apart = pair.apart[i];
    if (apart.stays) continue;
    const ClosestFeatures closest = closestFeatures(
        *world.shapes[at(apart.shapes.a)].part, world.bodies[at(pair.body_a)].path.at(time_s),
        *world.shapes[at(apart.shapes.b)].part, world.bodies[at(pair.body_b)].path.at(time_s), apart.tracked);
    counters.addQuery(closest.states);
    const int place = makeNear(of_bodies, i, closest, world);
    if (pair.added) extended_.push_back(place);
  }
  measure(pair);
}

// The pairs of these bodies, with what they have grown to, each once.
void PairTable::growPairs(std::span<const int> some, double time_s, const PairedWorld& world) {
  ++extension_;
  extended_in_.resize(world.bodies.size());
  bounded_in_.resize(world.bodies.size());
  const auto boundPath = [&](int body) {
    if (std::exchange(bounded_in_[at(body)], extension_) == extension_) return;
    path_bounds_[at(body)] = PathBound(world.bodies[at(body)].path, time_s, world.settings.step_s);
  };
  grown_.clear();
  for (const int body : some) {
    extended_in_[at(body)] = extension_;
    const std::vector<int>& places = pairs_of_body_[at(body)];
    const std::size_t known = places.size();
    pairGrown(body, time_s, world);
    boundPath(body);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const std::size_t added = places.size() - known;  // these first
      const int place = places[k < added ? known + k : k - added];
      const int other = bodyPairAt(place).other(body);
      if (k >= added && extended_in_[at(other)] == extension_) continue;  // that was asked already
      boundPath(other);
      grown_.push_back(place);
    }
  }
}

void PairTable::extend(std::span<const int> some, double time_s, const PairedWorld& world,
                       StepCounters& counters) {
  growPairs(some, time_s, world);
  world.crew.runStretches(grown_.size(), fewBodyPairs(), [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(grown_).subspan(begin, end - begin);
    visit(std::span(body_pairs_), places, [&](std::size_t, BodyPair& pair) {
      const double height = pair.contactHeight(world.settings.step_s);
      if (staysListed(pair, height)) lookAt(pair, height, world);
    });
  });
  for (const int place : grown_) comeNear(place, time_s, world, counters);
}

void PairTable::activate(int body, const std::vector<Body>& bodies, const WorldSettings& settings) {
  for (const int place : pairs_of_body_[at(body)]) {
    BodyPair& pair = bodyPairAt(place);
    if (pair.active) continue;
    if (resting_gap_m_ && pair.resting_gap_m <= *resting_gap_m_) resting_gap_m_.reset();
    pair.active = true;
    resting_candidates_ -= pair.candidates();
    pair.collision_speed_mps = collisionSpeedOf(pair, bodies, settings.step_s);
    active_pairs_.push_back(place);
  }
  for (const int place : of_body_[at(body)]) {
    ShapePair& pair = pairAt(place);
    if (pair.active) continue;
    if (resting_gap_m_ && pair.closest.distance_m <= *resting_gap_m_) resting_gap_m_.reset();
    scaleRemembered(pair, impulseScale(pair));
    pair.collision_speed_mps = bodyPairAt(pair.of_bodies).collision_speed_mps;
    pair.active = true;
    near_.push_back(place);
  }
}

// Powers of two come to the same, whether one by one or together.
void PairTable::scaleImpulses(double factor) {
  for (const int place : near_) scaleRemembered(pairAt(place), factor);
  scale_ *= factor;
}

// What is apart is at least as far as where contacts begin.
double PairTable::smallestGap(const std::vector<Body>& bodies, const std::vector<Shape>& shapes) const {
  if (!resting_gap_m_) {
    resting_gap_m_ = kInfinity;
    for (const BodyPair& pair : body_pairs_)
      if (!pair.isFree() && !pair.active) resting_gap_m_ = std::min(*resting_gap_m_, pair.resting_gap_m);
    for (const ShapePair& pair : pairs_)
      if (!pair.isFree() && !pair.active) resting_gap_m_ = std::min(*resting_gap_m_, pair.closest.distance_m);
  }
  double smallest = *resting_gap_m_;
  for (const int place : near_) smallest = std::min(smallest, pairAt(place).closest.distance_m);
  for (const int place : active_pairs_) {
    const BodyPair& pair = bodyPairAt(place);
    if (pair.window.manifold >= smallest) continue;
    for (ApartPieces apart : pair.apart)
      smallest = std::min(smallest, closestNow(apart.shapes, apart.tracked, bodies, shapes).distance_m);
  }
  return smallest;
}

std::vector<Candidate> PairTable::candidates(const std::vector<Body>& bodies,
                                             const std::vector<Shape>& shapes) const {
  std::vector<Candidate> all;
  for (const BodyPair& pair : body_pairs_) {
    for (ApartPieces apart : pair.apart)
      all.push_back({apart.shapes, pair.body_a, pair.body_b,
                     closestNow(apart.shapes, apart.tracked, bodies, shapes).distance_m});
    for (const int place : pair.near)
      all.push_back({pairAt(place).shapes, pair.body_a, pair.body_b, pairAt(place).closest.distance_m});
  }
  std::ranges::sort(all, {}, &Candidate::shapes);
  return all;
}

std::vector<int> PairTable::all() const {
  std::vector<int> places;
  places.reserve(pairs_.size() - free_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (!pairs_[i].isFree()) places.push_back(static_cast<int>(i));
  std::sort(places.begin(), places.end(), [this](int p, int q) { return isBefore(p, q); });
  return places;
}

bool PairTable::meetsOthers(const BodyPair& pair, const PairedWorld& world) const {
  const double height = pair.contactHeight(world.settings.step_s);
  if (!staysListed(pair, height)) return true;
  if (keepsRoom(pair, height)) return false;
  return std::ranges::any_of(pair.apart, [&](const ApartPieces& apart) {
    return !(boundOf(apart, world.shapes).within_m > height);
  });
}

std::span<const int> PairTable::bodiesThatMeetOthers(const PairedWorld& world, std::span<const int> active,
                                                     double end_s) {
  const std::vector<Body>& bodies = world.bodies;
  meets_.assign(bodies.size(), 0);
  const auto mark = [&](int body) { std::atomic_ref(meets_[at(body)]).store(1, std::memory_order_relaxed); };
  world.crew.runStretches(active.size(), kFewBodies, [&](std::size_t begin, std::size_t end) {
    for (const int b : active.subspan(begin, end - begin)) {
      if (!bodies[at(b)].moves()) continue;
      if (!proxies_[at(b)].bounds.contains(
              sweptBounds(starts_[at(b)], bounds_.reach(b), bodies[at(b)].path, end_s)))
        mark(b);
    }
  });
  boundPaths(bodies, active, end_s);
  world.crew.runStretches(active_pairs_.size(), fewBodyPairs(), [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(active_pairs_).subspan(begin, end - begin);
    visit(std::span<const BodyPair>(body_pairs_), places, [&](std::size_t, const BodyPair& pair) {
      if (meetsOthers(pair, world)) mark(bodies[at(pair.body_a)].moves() ? pair.body_a : pair.body_b);
    });
  });
  met_.clear();
  for (const int b : active)
    if (meets_[at(b)] != 0) met_.push_back(b);
  return met_;
}

void PairTable::requery(const PairedWorld& world, StepCounters& counters) {
  const auto travels = [&](int body) { return world.bodies[at(body)].travels(); };
  world.crew.runStretches(near_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    StepCounters made;
    const std::span<const int> places = std::span<const int>(near_).subspan(begin, end - begin);
    visit(std::span(pairs_), places, [&](std::size_t, ShapePair& pair) {
      if (!travels(pair.body_a) && !travels(pair.body_b)) return;
      pair.closest = closestNow(pair.shapes, pair.tracked, world.bodies, world.shapes);
      made.addQuery(pair.closest.states);
      made.iteration_limits += pair.closest.reached_limit;
    });
    std::atomic_ref(counters.distance_queries) += made.distance_queries;
    std::atomic_ref(counters.states_walked) += made.states_walked;
    std::atomic_ref(counters.iteration_limits) += made.iteration_limits;
  });
}

}  // namespace carom
