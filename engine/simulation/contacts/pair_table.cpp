#include "engine/simulation/contacts/pair_table.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
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

// What gravity, or a load, gives a body that falls through the window, or within a step: slower approaches
// are lasting contact. By and by not so where next to nothing is lost in a bounce, which then goes on for
// ever: at e = 1 only bounces shorter than a fraction of a step are left out. Still less between bodies that
// both fall: gravity never brings them together again. A trace of it always remains, or the rounding of a
// finished collision would be taken for another. A bounce that would last longer than a step, 2 e v / g, is
// one, however slow.
double collisionSpeed(const BodyPair& pair, const std::vector<Body>& bodies, double step_s) {
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
ClosestFeatures closestNow(const IndexPair& of, FeaturePair& tracked, const std::vector<Body>& bodies,
                           const std::vector<Shape>& shapes) {
  const Shape &a = shapes[at(of.a)], &b = shapes[at(of.b)];
  return closestFeatures(*a.part, bodies[at(a.body)].X_WB, *b.part, bodies[at(b.body)].X_WB, tracked);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
    pair.collision_speed_mps = collisionSpeed(pair, world.bodies, world.settings.step_s);
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

RelativeMotion PairTable::motionOf(const BodyPair& pair, const RelativePose& since) const {
  return motionSince(since, pathOf(pair.body_a), bounds_.reach(pair.body_a), pathOf(pair.body_b),
                     bounds_.reach(pair.body_b));
}

// Whether nothing that is not on its list could come so near.
bool PairTable::staysListed(const BodyPair& pair, double height_m) const {
  const ListedFor& listed = pair.listed;
  if (std::isinf(listed.gap_m)) return listed.gap_m > 0.0;
  return listed.gap_m - motionOf(pair, listed.since).beyond(listed.motion) > height_m;
}

// Whether nothing that was apart when that was measured could come so near.
bool PairTable::keepsRoom(const BodyPair& pair, double height_m) const {
  if (std::isinf(pair.room.gap_m)) return pair.room.gap_m > 0.0;
  return pair.room.gap_m - motionOf(pair, pair.room.since).most() > height_m;
}

// Along that of the world's axes on which the bounds are farthest apart where the paths begin.
SeparatingAxis PairTable::axisOfBounds(const IndexPair& of, const std::vector<Shape>& shapes) const {
  const Pose& X_WA = pathOf(shapes[at(of.a)].body).begin;
  const Pose& X_WB = pathOf(shapes[at(of.b)].body).begin;
  const Bounds a = bounds_.ofShape(of.a, shapes, X_WA), b = bounds_.ofShape(of.b, shapes, X_WB);
  const Vec3 above = b.low - a.high, below = a.low - b.high;
  Eigen::Index axis = 0;
  const double gap = above.cwiseMax(below).maxCoeff(&axis);
  const Vec3 n_W = Vec3::Unit(axis) * (above[axis] >= below[axis] ? 1.0 : -1.0);
  return separatingAxis(n_W, gap, X_WA, bounds_.ball(of.a), X_WB, bounds_.ball(of.b));
}

GapBound PairTable::boundOf(const ApartPieces& apart, const std::vector<Shape>& shapes) const {
  const IndexPair& of = apart.shapes;
  return boundGap(apart.axis, pathOf(shapes[at(of.a)].body), bounds_.ball(of.a),
                  pathOf(shapes[at(of.b)].body), bounds_.ball(of.b));
}

// What could come near on these paths, and on others that are not farther from them than the margin, by the
// bounds of the pieces as the bodies move against each other.
void PairTable::list(BodyPair& pair, bool keeps_all, const PairedWorld& world, ListScratch& scratch) {
  const PathBound &a = pathOf(pair.body_a), &b = pathOf(pair.body_b);
  scratch.found.clear();
  if (bounds_.shapesOf(pair.body_a) * bounds_.shapesOf(pair.body_b) == 1) {
    pair.listed.gap_m = kInfinity;
    scratch.found.push_back({bounds_.firstShape(pair.body_a), bounds_.firstShape(pair.body_b)});
  } else {
    const RelativePose now = relativePose(a, b);
    const RelativeMotion motion = motionOf(pair, now);
    pair.listed = {now, motion, pair.safeHeight(world.settings.step_s) + pair.margin_m};
    const double margin = pair.listed.gap_m + motion.turn_m;
    const auto seenFromA = [&](const Bounds& of_b) {
      return widened({of_b.low + motion.way_m.low, of_b.high + motion.way_m.high}, margin);
    };
    const auto seenFromB = [&](const Bounds& of_a) {
      return widened({of_a.low - motion.way_m.high, of_a.high - motion.way_m.low}, margin);
    };
    bounds_.findReaching(pair.body_a, a.begin, seenFromA(bounds_.ofBody(pair.body_b, b.begin)),
                         scratch.shapes_a);
    bounds_.findReaching(pair.body_b, b.begin, seenFromB(bounds_.ofBody(pair.body_a, a.begin)),
                         scratch.shapes_b);
    scratch.a.clear();
    scratch.b.clear();
    for (const int i : scratch.shapes_a) scratch.a.push_back(bounds_.ofShape(i, world.shapes, a.begin));
    for (const int i : scratch.shapes_b)
      scratch.b.push_back(seenFromA(bounds_.ofShape(i, world.shapes, b.begin)));
    overlapsBetween(scratch.a, scratch.b, kMostPairs, scratch.found);
    for (IndexPair& found : scratch.found)
      found = {scratch.shapes_a[at(found.a)], scratch.shapes_b[at(found.b)]};
  }
  pair.room = {};
  takeListed(pair, keeps_all, world, scratch);
}

// What was apart already keeps its axis.
void PairTable::takeListed(BodyPair& pair, bool keeps_all, const PairedWorld& world, ListScratch& scratch) {
  scratch.near.clear();
  for (const int place : pair.near) scratch.near.push_back(pairAt(place).shapes);
  std::sort(scratch.near.begin(), scratch.near.end());
  scratch.apart.clear();
  auto known = pair.apart.begin();
  const auto passBefore = [&](const IndexPair* next) {
    for (; known != pair.apart.end() && (next == nullptr || known->shapes < *next); ++known)
      if (keeps_all) scratch.apart.push_back(*known);
  };
  for (const IndexPair& found : scratch.found) {
    if (std::binary_search(scratch.near.begin(), scratch.near.end(), found)) continue;
    passBefore(&found);
    if (known != pair.apart.end() && known->shapes == found)
      scratch.apart.push_back(*known++);
    else
      scratch.apart.push_back({.shapes = found, .axis = axisOfBounds(found, world.shapes)});
  }
  passBefore(nullptr);
  pair.apart.swap(scratch.apart);
}

// Asks what is apart where the motion of the bodies against each other does not prove that it stays so.
void PairTable::lookAt(BodyPair& pair, double height_m, const PairedWorld& world) {
  if (!pair.to_measure && keepsRoom(pair, height_m)) return;
  pair.to_measure = true;
  const auto bound = [&](ApartPieces& apart) {
    const GapBound gap = boundOf(apart, world.shapes);
    apart.gap_m = gap.at_begin_m;
    apart.stays = gap.within_m > height_m;
    return apart.stays;
  };
  for (ApartPieces& apart : pair.apart) {
    if (bound(apart)) continue;
    apart.axis = axisOfBounds(apart.shapes, world.shapes);
    bound(apart);
  }
}

// So many of them have together as many candidates as one thread works on.
std::size_t PairTable::fewBodyPairs() const {
  return std::max<std::size_t>(1, kFewPairs * active_pairs_.size() / std::max<std::size_t>(1, listed_));
}

void PairTable::lookAtAll(const PairedWorld& world) {
  std::atomic<std::size_t> listed = 0;
  world.crew.runStretches(active_pairs_.size(), fewBodyPairs(), [&](std::size_t begin, std::size_t end) {
    ListScratch scratch;
    const std::span<const int> places = std::span<const int>(active_pairs_).subspan(begin, end - begin);
    visit(std::span(body_pairs_), places, [&](std::size_t, BodyPair& pair) {
      const double height = pair.safeHeight(world.settings.step_s);
      if (!staysListed(pair, height)) {
        list(pair, false, world, scratch);
        if ((listed += pair.apart.size()) > kMostPairs) throw TooManyPairs();
      }
      lookAt(pair, height, world);
    });
  });
}

// How near what has just been looked at and stays apart is where the paths begin.
void PairTable::measure(BodyPair& pair) {
  std::erase_if(pair.apart, [](const ApartPieces& apart) { return !apart.stays; });
  pair.to_measure = false;
  pair.room = {relativePose(pathOf(pair.body_a), pathOf(pair.body_b)), kInfinity};
  for (const ApartPieces& apart : pair.apart) pair.room.gap_m = std::min(pair.room.gap_m, apart.gap_m);
}

// Whether the normal of the closest features is an axis that parts the pieces, with room for what contacts
// do.
bool PairTable::standsOff(ApartPieces& apart, const ClosestFeatures& closest, const BodyPair& pair,
                          const PairedWorld& world) const {
  const double step_s = world.settings.step_s;
  if (closest.distance_m <= pair.contactHeight(step_s)) return false;
  apart.axis = separatingAxis(closest.n_W, closest.distance_m, world.bodies[at(pair.body_a)].X_WB,
                              bounds_.ball(apart.shapes.a), world.bodies[at(pair.body_b)].X_WB,
                              bounds_.ball(apart.shapes.b));
  const GapBound gap = boundOf(apart, world.shapes);
  apart.gap_m = gap.at_begin_m;
  return gap.within_m > pair.safeHeight(step_s);
}

// What was near and is not any more.
void PairTable::tellApart(const PairedWorld& world) {
  stays_apart_.assign(near_.size(), 0);
  world.crew.runStretches(near_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(near_).subspan(begin, end - begin);
    visit(std::span(pairs_), places, [&](std::size_t i, ShapePair& pair) {
      const BodyPair& both = bodyPairAt(pair.of_bodies);
      pair.collision_speed_mps = both.collision_speed_mps;
      ApartPieces apart{.shapes = pair.shapes};
      stays_apart_[begin + i] = standsOff(apart, pair.closest, both, world) ? 1 : 0;
    });
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const int place = near_[i];
    if (stays_apart_[i] == 0) {
      near_[kept++] = place;
      continue;
    }
    const ShapePair& pair = pairAt(place);
    BodyPair& both = bodyPairAt(pair.of_bodies);
    ApartPieces apart{.shapes = pair.shapes, .tracked = pair.tracked};
    standsOff(apart, pair.closest, both, world);
    const auto later = std::ranges::upper_bound(both.apart, apart.shapes, {}, &ApartPieces::shapes);
    both.apart.insert(later, apart);
    both.to_measure = true;
    remove(place, world.bodies);
  }
  near_.resize(kept);
}

// What was apart is queried where that is not proven any more, and is near where that does not prove it
// either.
void PairTable::askApart(const PairedWorld& world, StepCounters& counters, PhaseClock* clock) {
  asked_.clear();
  for (const int place : active_pairs_) {
    const BodyPair& pair = bodyPairAt(place);
    if (!pair.to_measure) continue;
    for (std::size_t i = 0; i < pair.apart.size(); ++i)
      if (!pair.apart[i].stays) asked_.push_back({place, i, {}});
  }
  {
    const PhaseScope phase(clock, StepPhase::kClosestFeatures);
    world.crew.runStretches(asked_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
      for (Asked& asked : std::span(asked_).subspan(begin, end - begin)) {
        BodyPair& pair = bodyPairAt(asked.of_bodies);
        ApartPieces& apart = pair.apart[asked.index];
        asked.closest = closestNow(apart.shapes, apart.tracked, world.bodies, world.shapes);
        apart.stays = standsOff(apart, asked.closest, pair, world);
      }
    });
  }
  for (const Asked& asked : asked_) {
    counters.addQuery(asked.closest.states);
    counters.iteration_limits += asked.closest.reached_limit;
    if (!bodyPairAt(asked.of_bodies).apart[asked.index].stays)
      makeNear(asked.of_bodies, asked.index, asked.closest, world);
  }
  for (const int place : active_pairs_) {
    BodyPair& pair = bodyPairAt(place);
    if (pair.to_measure) measure(pair);
  }
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
    added.collision_speed_mps = collisionSpeed(added, world.bodies, world.settings.step_s);
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
  }
  lookAt(pair, height, world);
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
      comeNear(place, time_s, world, counters);
    }
  }
}

void PairTable::activate(int body, const std::vector<Body>& bodies, const WorldSettings& settings) {
  for (const int place : pairs_of_body_[at(body)]) {
    BodyPair& pair = bodyPairAt(place);
    if (pair.active) continue;
    if (resting_gap_m_ && pair.resting_gap_m <= *resting_gap_m_) resting_gap_m_.reset();
    pair.active = true;
    resting_candidates_ -= pair.candidates();
    pair.collision_speed_mps = collisionSpeed(pair, bodies, settings.step_s);
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
