// What two bodies know of their pieces that are apart: which of them could come near, and for how much motion
// of the bodies against each other nobody has to ask.

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/foundation/index.h"
#include "engine/foundation/visit.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/contacts/pair_table.h"

namespace carom {

// As the bodies were at the end of the last step.
ClosestFeatures PairTable::closestNow(const IndexPair& of, FeaturePair& tracked,
                                      const std::vector<Body>& bodies, const std::vector<Shape>& shapes) {
  const Shape &a = shapes[at(of.a)], &b = shapes[at(of.b)];
  return closestFeatures(*a.part, bodies[at(a.body)].X_WB, *b.part, bodies[at(b.body)].X_WB, tracked);
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
  told_apart_.resize(near_.size());
  world.crew.runStretches(near_.size(), kFewPairs, [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(near_).subspan(begin, end - begin);
    visit(std::span(pairs_), places, [&](std::size_t i, ShapePair& pair) {
      const BodyPair& both = bodyPairAt(pair.of_bodies);
      pair.collision_speed_mps = both.collision_speed_mps;
      ApartPieces& apart = told_apart_[begin + i];
      apart.shapes = pair.shapes;
      apart.tracked = pair.tracked;
      apart.stays = standsOff(apart, pair.closest, both, world);
    });
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const int place = near_[i];
    const ApartPieces& apart = told_apart_[i];
    if (!apart.stays) {
      near_[kept++] = place;
      continue;
    }
    BodyPair& both = bodyPairAt(pairAt(place).of_bodies);
    both.apart.insert(std::ranges::upper_bound(both.apart, apart.shapes, {}, &ApartPieces::shapes), apart);
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
  world.crew.runStretches(active_pairs_.size(), fewBodyPairs(), [&](std::size_t begin, std::size_t end) {
    const std::span<const int> places = std::span<const int>(active_pairs_).subspan(begin, end - begin);
    visit(std::span(body_pairs_), places, [&](std::size_t, BodyPair& pair) {
      if (pair.to_measure) measure(pair);
    });
  });
}

}  // namespace carom
