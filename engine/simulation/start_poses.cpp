#include "engine/simulation/start_poses.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "engine/foundation/index.h"
#include "engine/modes/islands.h"
#include "engine/simulation/least_displacements.h"

namespace carom {
namespace {

// Of the smaller body's width, at most a metre: a pair that is less deep or less far apart touches, as its
// poses are rounded.
constexpr double kOverlap = 1e-9;
// Of how far from the origin the bodies are: what the rounding of their places adds to that.
constexpr double kPlaceRounding = 8.0 * std::numeric_limits<double>::epsilon();
// Of the rest gap: how much farther apart two parts are asked for their normal, far above rounding.
constexpr double kApart = 1e-2;
// A gap is not opened where even the free axes of its bodies lead only by this sine or less out of its plane:
// to open it they would have to be moved ten times as far and more.
constexpr double kGlancingSine = 0.1;
// Rounds after which the displacements are taken as they are. Each finds pairs that the last one's
// displacements could meet, or less room than it had assumed.
constexpr int kDisplacementRounds = 8;

double roundingOf(const ShapePair& pair, const std::vector<Body>& bodies) {
  const double scale = pair.window.rest / tolerance::kRestGap;
  const double away =
      std::max(bodies[at(pair.body_a)].X_WB.position.norm(), bodies[at(pair.body_b)].X_WB.position.norm());
  return kOverlap * scale + kPlaceRounding * away;
}

// The place of each pair of bodies where `depthOf` is greatest and not below zero, deepest first.
template <typename Depth>
std::vector<Overlap> overlapsOf(const PairTable& table, const Depth& depthOf) {
  std::map<std::pair<int, int>, Overlap> deepest;
  for (const int place : table.active()) {
    const ShapePair& pair = table.pairs()[at(place)];
    const double depth = depthOf(pair);
    if (!(depth >= 0.0)) continue;
    Overlap& overlap = deepest[{pair.body_a, pair.body_b}];
    if (overlap.body_a >= 0 && overlap.depth_m >= depth) continue;
    overlap = {pair.body_a, pair.body_b, depth, 0.5 * (pair.closest.p_A_W + pair.closest.p_B_W)};
  }
  std::vector<Overlap> overlaps;
  overlaps.reserve(deepest.size());
  for (const auto& [bodies, overlap] : deepest) overlaps.push_back(overlap);
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const Overlap& x, const Overlap& y) { return x.depth_m > y.depth_m; });
  return overlaps;
}

// Below it a gap is opened to the rest gap; from here on lasting contact holds it as it is.
double shortGap(const ShapePair& pair) {
  return (1.0 - tolerance::kRestBand) * pair.window.rest;
}

/// Parallel planes between two parts: their normal, from A to B, and how far they are from each other.
struct PartingPlanes {
  Vec3 n_W;
  double gap_m = 0.0;
};

// Where faces just touch at an edge or a corner, many normals are true. So it is asked where the parts would
// be closest if they were a little farther apart along the line between their middles, which parts them along
// any of these normals. At gaps that are not short there is one.
PartingPlanes partingPlanes(const ShapePair& pair, const StartingBodies& start) {
  if (pair.closest.distance_m >= shortGap(pair)) return {pair.closest.n_W, pair.closest.distance_m};
  const ConvexPart& a = *start.shapes[at(pair.shapes.a)].part;
  const ConvexPart& b = *start.shapes[at(pair.shapes.b)].part;
  const Pose& X_WA = start.bodies[at(pair.body_a)].X_WB;
  Pose X_WB = start.bodies[at(pair.body_b)].X_WB;
  const Vec3 between = X_WB * b.core.center() - X_WA * a.core.center();
  const Vec3 apart = kApart * pair.window.rest * between.normalized();
  X_WB.position += apart;
  FeaturePair tracked;
  const ClosestFeatures closest = closestFeatures(a, X_WA, b, X_WB, tracked);
  return {closest.n_W, closest.distance_m - dot(closest.n_W, apart)};
}

/// Gaps that pairs of shapes are to have instead of the rest gap.
using SharedGaps = std::map<IndexPair, double>;

/// What the pairs of the table are to do: each has an opening.
struct OpeningPairs {
  std::vector<Opening> openings;
  std::vector<IndexPair> shapes;
  std::vector<double> wanted_m;
};

// Whether axes that are locked hold the pair together, or neither of its bodies gives way at all.
bool isHeld(const ShapePair& pair, const Vec3& n_W, const std::vector<Body>& bodies) {
  double free_part = 0.0;
  for (const int index : {pair.body_a, pair.body_b})
    if (const Body& body = bodies[at(index)]; body.yields())
      free_part += body.locks.movingPart(n_W).squaredNorm();
  return free_part <= kGlancingSine * kGlancingSine;
}

double wantedGap(const ShapePair& pair, const SharedGaps& shared) {
  const auto found = shared.find(pair.shapes);
  const double wanted = found == shared.end() ? pair.window.rest : found->second;
  // What is no less than the band's low end is held as it is: it need not be opened, nor close further.
  return pair.closest.distance_m >= shortGap(pair) ? std::min(pair.closest.distance_m, wanted) : wanted;
}

// Parallel planes keep their parts apart however far bodies are moved, as long as these do not turn: the
// openings are exact. A short gap of a pair that is held is kept as it is.
OpeningPairs openingPairs(const StartingBodies& start, const SharedGaps& shared) {
  OpeningPairs all;
  for (const int place : start.table.active()) {
    const ShapePair& pair = start.table.pairs()[at(place)];
    const auto giving = [&](int body) { return start.bodies[at(body)].yields() ? body : -1; };
    const PartingPlanes planes = partingPlanes(pair, start);
    double wanted_m = wantedGap(pair, shared);
    if (isHeld(pair, planes.n_W, start.bodies)) wanted_m = std::min(wanted_m, planes.gap_m);
    all.openings.push_back({giving(pair.body_a), giving(pair.body_b), planes.n_W, wanted_m - planes.gap_m});
    all.shapes.push_back(pair.shapes);
    all.wanted_m.push_back(wanted_m);
  }
  return all;
}

// Pairs that lack room and have a body in common that could give way share the room there is: each gets the
// same part of the gap that it wanted. Whether any was given less.
bool shareRoom(const OpeningPairs& pairs, const LeastDisplacements& least, int bodies, SharedGaps& shared) {
  std::vector<std::size_t> lacking;
  for (std::size_t k = 0; k < pairs.openings.size(); ++k)
    if (least.missing_m[k] > tolerance::kRestBand * pairs.wanted_m[k]) lacking.push_back(k);
  Islands jams(bodies);
  for (const std::size_t k : lacking)
    if (const Opening& o = pairs.openings[k]; o.a >= 0 && o.b >= 0) jams.join(o.a, o.b);
  // Of each jam, weighted by the forces in it, which what is missing is in proportion to.
  struct Jam {
    double wanted = 0.0;
    double missing = 0.0;
  };
  std::vector<Jam> sums(at(bodies));
  const auto jamOf = [&](std::size_t k) -> Jam& {
    return sums[at(jams.of(std::max(pairs.openings[k].a, pairs.openings[k].b)))];
  };
  for (const std::size_t k : lacking) {
    jamOf(k).wanted += least.missing_m[k] * pairs.wanted_m[k];
    jamOf(k).missing += least.missing_m[k] * least.missing_m[k];
  }
  bool lowered = false;
  for (const std::size_t k : lacking) {
    const double share = 1.0 - jamOf(k).missing / jamOf(k).wanted;
    if (!(share > 0.0)) continue;  // there is none
    shared[pairs.shapes[k]] = share * pairs.wanted_m[k];
    lowered = true;
  }
  return lowered;
}

// Whether displacements take bodies to where they could meet others that they are not paired with yet; then
// they are now.
bool pairOnTheWay(const StartingBodies& start, const std::vector<Vec3>& displacements) {
  constexpr double kWay_s = 1.0;  // the displacements are paths of one second
  Crew alone;
  for (std::size_t i = 0; i < start.bodies.size(); ++i) {
    Body& body = start.bodies[i];
    body.path = Trajectory{.X_WB = body.X_WB, .velocity = displacements[i] / kWay_s};
  }
  const PairedWorld world{start.bodies, start.shapes, start.settings, alone};
  if (start.table.bodiesThatMeetOthers(world, start.active, kWay_s).empty()) return false;
  const auto shapesOfPairs = [&] {
    std::vector<IndexPair> shapes;
    for (const int place : start.table.active()) shapes.push_back(start.table.pairs()[at(place)].shapes);
    return shapes;
  };
  const std::vector<IndexPair> before = shapesOfPairs();
  StepCounters counters;
  start.table.updateBounds(start.bodies, start.shapes, start.active, kWay_s, alone);
  start.table.collect(world, counters, nullptr);
  const std::vector<IndexPair> now = shapesOfPairs();
  return !std::includes(before.begin(), before.end(), now.begin(), now.end());
}

std::vector<Vec3> displacementsOf(const StartingBodies& start) {
  const int bodies = static_cast<int>(start.bodies.size());
  std::vector<Vec3> free_axes;
  for (const Body& body : start.bodies) free_axes.push_back(body.locks.free_axes);
  SharedGaps shared;
  for (int round = 0;; ++round) {
    const OpeningPairs pairs = openingPairs(start, shared);
    LeastDisplacements least = leastDisplacements(pairs.openings, free_axes);
    if (round == kDisplacementRounds) return std::move(least.displacement_W);
    if (!pairOnTheWay(start, least.displacement_W) && !shareRoom(pairs, least, bodies, shared))
      return std::move(least.displacement_W);
  }
}

}  // namespace

std::vector<Overlap> overlapsAtStart(const StartingBodies& start) {
  return overlapsOf(start.table, [&](const ShapePair& pair) {
    const double depth = -pair.closest.distance_m;
    return depth > roundingOf(pair, start.bodies) ? depth : -1.0;
  });
}

bool openTouching(const StartingBodies& start) {
  const std::vector<int>& pairs = start.table.active();
  const auto isShort = [&](int place) {
    const ShapePair& pair = start.table.pairs()[at(place)];
    return pair.closest.distance_m < shortGap(pair);
  };
  if (std::none_of(pairs.begin(), pairs.end(), isShort)) return false;
  const std::vector<Vec3> displacements = displacementsOf(start);
  for (std::size_t i = 0; i < start.bodies.size(); ++i)
    if (!displacements[i].isZero(0.0)) start.bodies[i].X_WB.position += displacements[i];
  Crew alone;
  StepCounters counters;
  start.table.requery({start.bodies, start.shapes, start.settings, alone}, counters);
  return true;
}

std::vector<Overlap> stillTouching(const StartingBodies& start) {
  std::vector<Overlap> touching = overlapsOf(start.table, [&](const ShapePair& pair) {
    return roundingOf(pair, start.bodies) - pair.closest.distance_m;
  });
  for (Overlap& pair : touching) pair.depth_m = 0.0;
  return touching;
}

}  // namespace carom
