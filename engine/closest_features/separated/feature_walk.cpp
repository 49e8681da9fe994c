#include "engine/closest_features/separated/feature_walk.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>

#include "engine/closest_features/pair/v_region.h"
#include "engine/closest_features/separated/level_axes.h"
#include "engine/foundation/stack_arena.h"

namespace carom {
namespace {

// A slope below this is rounding of a unit product: walking along it could not shorten the distance
// measurably.
constexpr double kFlatSlope = 1e-15;
// Distances this close, relative to the size, are equal to rounding.
constexpr double kAsClose = 0x1p-51;
// A distance that may be wrong by more than this, relative to the size, is looked at again.
constexpr double kDoubtful = 0x1p-50;
// A slope s gains d s^2 / 2 at distance d, which rounding hides up to s^2 = 1e-16 * size / d or so. Features
// this close to level at a distance of the size, and closer in proportion, are looked at together.
constexpr double kLevelSine = 1e-6;
// Bytes for the axes that are level with a pair, of which there are rarely more than four.
constexpr std::size_t kAxesBytes = 64 * sizeof(MinimumTranslation);

// The vertices that face each other along a direction from A to B.
FeaturePair facingVertices(const PolyhedronPair& pair, const Vec3& toward_b) {
  const int va = pair.a.support(toward_b);
  const int vb = pair.b.support(-pair.directionToB(toward_b));
  return {vertexFeature(va), vertexFeature(vb)};
}

// A point outside A whose way to a point of A's surface begins inside A: the face through which that way
// enters A, or -1 when the point is inside. Frame of A.
int entryFace(const ConvexPolyhedron& a, const Vec3& from, const Vec3& to) {
  int entry = -1;
  double latest = -1.0;
  for (int f = 0; f < a.faceCount(); ++f) {
    const double h_from = a.plane(f).signedDistance(from);
    if (h_from <= 0.0) continue;
    const double h_to = std::min(a.plane(f).signedDistance(to), 0.0);
    const double t = h_from / (h_from - h_to);
    if (t > latest) {
      latest = t;
      entry = f;
    }
  }
  return entry;
}

// The feature and what of the body's surface touches it and is almost level across `n`: edges and faces at
// its vertices. More of them than fit stay out; they only serve to find a shorter way.
struct LevelNeighbours {
  LevelNeighbours(const ConvexPolyhedron& polyhedron, Feature feature, const Vec3& n, double level_sine) {
    const auto visitVertex = [&](int v) {
      for (const Spoke& spoke : polyhedron.spokes(v)) {
        if (std::abs(dot(spoke.direction, n)) > level_sine) continue;
        add(edgeFeature(spoke.edge));
        const Edge& edge = polyhedron.edge(spoke.edge);
        for (int f : {edge.left, edge.right})
          if (f >= 0 && polyhedron.plane(f).normal.cross(n).norm() <= level_sine) add(faceFeature(f));
      }
    };
    add(feature);
    switch (feature.kind) {
      case FeatureKind::kVertex:
        visitVertex(feature.index);
        break;
      case FeatureKind::kEdge:
        visitVertex(polyhedron.edge(feature.index).tail);
        visitVertex(polyhedron.edge(feature.index).head);
        break;
      case FeatureKind::kFace:
        for (int v : polyhedron.faceVertices(feature.index)) visitVertex(v);
        break;
    }
  }

  std::span<const Feature> all() const { return {features_.data(), count_}; }

 private:
  void add(Feature feature) {
    const std::span<const Feature> known = all();
    if (count_ < features_.size() && std::find(known.begin(), known.end(), feature) == known.end())
      features_[count_++] = feature;
  }

  std::array<Feature, 16> features_;
  std::size_t count_ = 0;
};

// Two faces stand for one of them and the other body's vertex that faces it.
FeatureDistance anyFeatureDistance(const PolyhedronPair& pair, FeaturePair features) {
  if (features.a.kind == FeatureKind::kFace && features.b.kind == FeatureKind::kFace)
    features.b = vertexFeature(pair.b.support(-pair.directionToB(pair.a.plane(features.a.index).normal)));
  return featureDistance(pair, features);
}

int dimensions(const FeaturePair& features) {
  return static_cast<int>(features.a.kind) + static_cast<int>(features.b.kind);
}

}  // namespace

FeatureWalk::FeatureWalk(const PolyhedronPair& pair, FeaturePair seed, double size_m, double noise_m)
    : pair_(pair),
      size_m_(size_m),
      noise_m_(noise_m),
      noise_slope_(noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge())),
      seen_{anyFeatureDistance(pair, seed), FeatureDistance{}},
      lowest_m2_(seen_[0].squared_m2),
      across_{Vec3::Zero(), 1.0, false} {}

Move FeatureWalk::next() {
  const FeatureDistance& at = here();
  if (at.squared_m2 == 0.0) {  // an edge that goes through a face has no distance either
    common_is_on_a_ = false;
    return Move::kInside;
  }
  if (at.behind) return at.features.a.kind == FeatureKind::kFace ? enterA() : enterB();
  across_ = acrossOf(pair_, at);
  const Across& n = across_;
  const Vec3 minus_n_B = -pair_.directionToB(n.w);
  const double flat = kFlatSlope * n.length;
  // The steeper way first: so both orders of the bodies go the same way, and a level step that leaves as many
  // dimensions does not bar a steeper one.
  const WayOff off_a = steepestWayOff(pair_.a, at.features.a, n.w);
  const WayOff off_b = steepestWayOff(pair_.b, at.features.b, minus_n_B);
  const double steepest = std::max(off_a.slope, off_b.slope);
  if (steepest > flat) {
    const FeaturePair on_a{off_a.neighbour, at.features.b}, on_b{at.features.a, off_b.neighbour};
    const bool a_first = off_a.slope >= off_b.slope;
    if (moveTo(a_first ? on_a : on_b)) return Move::kTaken;
    if (std::min(off_a.slope, off_b.slope) > flat && moveTo(a_first ? on_b : on_a)) return Move::kTaken;
  }
  // Every way off leads down by more than rounding can hide: both bodies lie beyond their support planes.
  const double margin = noise_slope_ * n.length + (n.exact ? 0.0 : noise_m_);
  if (steepest < -margin && at.inside_m > noise_m_ && at.squared_m2 > noise_m_ * noise_m_)
    return Move::kClear;
  if (pointsInward(pair_.a, at.features.a, n.w)) return enterA();
  if (pointsInward(pair_.b, at.features.b, minus_n_B)) return enterB();
  if (at.distance() <= noise_m_) {  // touching or deep inside: the axes tell
    common_is_on_a_ = false;
    return Move::kInside;
  }
  const Vec3 unit = n.unit();
  const double unproven = at.distance() - slabAlong(pair_, at.features, unit);
  if (unproven <= kDoubtful * size_m_) return Move::kLevel;
  if (moveToLevelAxis() || moveAlongBoth(unit, minus_n_B / n.length)) return Move::kTaken;
  return unproven <= kUnproven * size_m_ ? Move::kLevel : Move::kLost;
}

bool FeatureWalk::asClose(const FeatureDistance& there) const {
  return there.squared_m2 - lowest_m2_ <= 2.0 * kAsClose * size_m_ * std::sqrt(lowest_m2_);
}

void FeatureWalk::jump() {
  moveTo(facingVertices(pair_, pair_.toA(pair_.b.center()) - pair_.a.center())) ||
      moveTo(facingVertices(pair_, here().p_b - here().p_a));
}

void FeatureWalk::restart(FeaturePair seed) {
  startFrom(anyFeatureDistance(pair_, seed));
}

void FeatureWalk::startFrom(const FeatureDistance& found) {
  seen_[here_] = found;
  lowest_m2_ = found.squared_m2;
  common_is_on_a_ = false;
}

bool FeatureWalk::moveTo(FeaturePair features) {
  // Built in its place: to copy what has just been written costs more than to compute it.
  const FeatureDistance& there =
      *::new (&seen_[1 - here_]) FeatureDistance(anyFeatureDistance(pair_, features));
  const bool closer = there.crossing || there.squared_m2 < lowest_m2_;
  if (!closer && !(asClose(there) && dimensions(there.features) > dimensions(here().features))) return false;
  lowest_m2_ = std::min(lowest_m2_, there.squared_m2);
  here_ = 1 - here_;
  return true;
}

// The way between the witnesses ends inside a body: the other witness is inside too, or the entry face is
// closer.
Move FeatureWalk::enterA() {
  return moveToEntry(entryFace(pair_.a, here().p_b, here().p_a), true);
}
Move FeatureWalk::enterB() {
  return moveToEntry(entryFace(pair_.b, pair_.toB(here().p_a), pair_.toB(here().p_b)), false);
}

Move FeatureWalk::moveToEntry(int face, bool entered_a) {
  common_is_on_a_ = !entered_a;
  if (face < 0) return Move::kInside;
  const Feature entry = faceFeature(face);
  const bool moved =
      moveTo(entered_a ? FeaturePair{entry, here().features.b} : FeaturePair{here().features.a, entry});
  // A way that enters at the witness itself finds no closer face.
  return moved ? Move::kTaken : Move::kLost;
}

// The features of a slab wider than the present one are closer than the present ones, if they hold it.
bool FeatureWalk::moveToLevelAxis() {
  StackArena<kAxesBytes> arena;
  MinimumTranslations axes(&arena);
  gatherLevelAxes(pair_, answerFrom(pair_, here()), noise_m_, axes);
  bool moved = false;
  for (const MinimumTranslation& axis : axes) moved = moveTo(axis.features) || moved;
  return moved;
}

// Between almost parallel features a step on one body alone gains less than rounding (half the slope
// squared), a step on both together gains the slope itself. Where not even that can be measured the support
// planes tell: the slab of the closest pair is the widest.
bool FeatureWalk::moveAlongBoth(const Vec3& n, const Vec3& minus_n_B) {
  const double level_sine = kLevelSine * std::sqrt(std::max(1.0, size_m_ / here().distance()));
  const LevelNeighbours on_a(pair_.a, here().features.a, n, level_sine);
  const LevelNeighbours on_b(pair_.b, here().features.b, minus_n_B, level_sine);
  bool moved = false;
  for (const Feature a : on_a.all())
    for (const Feature b : on_b.all()) moved = moveTo({a, b}) || moved;
  if (moved) return true;
  const double slab = slabAlong(pair_, here().features, n);
  if (here().distance() - slab <= kUnproven * size_m_) return false;
  for (const Feature a : on_a.all())
    for (const Feature b : on_b.all())
      if (moveToWiderSlab({a, b}, slab)) return true;
  return false;
}

bool FeatureWalk::moveToWiderSlab(FeaturePair features, double slab_m) {
  const FeatureDistance there = anyFeatureDistance(pair_, features);
  if (!asClose(there) || dimensions(there.features) < dimensions(here().features)) return false;
  const Vec3 n = acrossOf(pair_, there).unit();
  if (slabAlong(pair_, there.features, n) <= slab_m + kDoubtful * size_m_) return false;
  seen_[1 - here_] = there;
  here_ = 1 - here_;
  return true;
}

}  // namespace carom
