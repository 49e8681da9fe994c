#include "engine/closest_features/feature_walk.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>
#include <vector>

#include "engine/closest_features/level_axes.h"
#include "engine/closest_features/v_region.h"

namespace carom {
namespace {

// A slope below this is rounding of a unit product: walking along it could not shorten the distance
// measurably.
constexpr double kFlatSlope = 1e-15;
// Squared distances this close are equal, to rounding.
constexpr double kAsClose = 1.0 + 0x1p-50;
// A distance that may be wrong by more than this, relative to the size, is looked at again.
constexpr double kSlack = 0x1p-50;
// A slope s gains d s^2 / 2 at distance d, which rounding hides up to s^2 = 1e-16 * size / d or so. Features
// this close to level at a distance of the size, and closer in proportion, are looked at together.
constexpr double kLevelSine = 1e-6;

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
        if (std::abs(spoke.direction.dot(n)) > level_sine) continue;
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

// The closed features' distance, of two faces too: those are closest at an edge of one of them.
FeatureDistance anyFeatureDistance(const PolyhedronPair& pair, Feature a, Feature b) {
  if (a.kind != FeatureKind::kFace || b.kind != FeatureKind::kFace) return featureDistance(pair, {a, b});
  FeatureDistance best = featureDistance(pair, {edgeFeature(pair.a.faceEdges(a.index)[0]), b});
  const auto consider = [&](FeaturePair features) {
    const FeatureDistance there = featureDistance(pair, features);
    if (there.crossing || (!best.crossing && there.squared_m2 < best.squared_m2)) best = there;
  };
  for (int e : pair.a.faceEdges(a.index)) consider({edgeFeature(e), b});
  for (int e : pair.b.faceEdges(b.index)) consider({a, edgeFeature(e)});
  return best;
}

int dimensions(const FeaturePair& features) {
  return static_cast<int>(features.a.kind) + static_cast<int>(features.b.kind);
}

}  // namespace

FeaturePair coldSeed(const PolyhedronPair& pair) {
  return facingVertices(pair, pair.toA(pair.b.center()) - pair.a.center());
}

FeatureWalk::FeatureWalk(const PolyhedronPair& pair, FeaturePair seed, double size_m, double noise_m)
    : pair_(pair),
      size_m_(size_m),
      noise_m_(noise_m),
      noise_slope_(noise_m * std::max(pair.a.inverseShortestEdge(), pair.b.inverseShortestEdge())),
      seen_{anyFeatureDistance(pair, seed.a, seed.b), FeatureDistance{}},
      lowest_m2_(seen_[0].squared_m2) {}

Move FeatureWalk::next() {
  const FeatureDistance& at = here();
  if (at.crossing || at.squared_m2 == 0.0) {
    common_is_on_a_ = false;
    return Move::kInside;
  }
  if (at.behind) return at.features.a.kind == FeatureKind::kFace ? enterA() : enterB();
  const Across n = acrossOf(pair_, at);
  const Vec3 minus_n_B = -pair_.directionToB(n.w);
  const double flat = kFlatSlope * n.length;
  const WayOff off_a = steepestWayOff(pair_.a, at.features.a, n.w);
  if (off_a.slope > flat && moveTo({off_a.neighbour, at.features.b})) return Move::kTaken;
  const WayOff off_b = steepestWayOff(pair_.b, at.features.b, minus_n_B);
  if (off_b.slope > flat && moveTo({at.features.a, off_b.neighbour})) return Move::kTaken;
  // Every way off leads down by more than rounding can hide: both bodies lie beyond their support planes.
  const double steepest = std::max(off_a.slope, off_b.slope);
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
  if (at.distance() - slabAlong(pair_, at.features, unit) <= kSlack * size_m_) return Move::kStuck;
  return moveToLevelAxis() || moveAlongBoth(unit, minus_n_B / n.length) ? Move::kTaken : Move::kStuck;
}

void FeatureWalk::jump() {
  moveTo(coldSeed(pair_)) || moveTo(facingVertices(pair_, here().p_b - here().p_a));
}

bool FeatureWalk::moveTo(FeaturePair features) {
  // Built in its place: to copy what has just been written costs more than to compute it.
  const FeatureDistance& there =
      *::new (&seen_[1 - here_]) FeatureDistance(anyFeatureDistance(pair_, features.a, features.b));
  const bool closer = there.crossing || there.squared_m2 < lowest_m2_;
  const bool as_close = there.squared_m2 <= lowest_m2_ * kAsClose;
  if (!closer && !(as_close && dimensions(there.features) > dimensions(here().features))) return false;
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
  // Only rounding can deny the closer face: the witness then is in the surface, and the axes decide.
  return moved ? Move::kTaken : Move::kInside;
}

// The features of a slab wider than the present one are closer than the present ones, if they hold it.
bool FeatureWalk::moveToLevelAxis() {
  thread_local std::vector<MinimumTranslation> axes;
  gatherLevelAxes(pair_, answerFrom(pair_, here()), noise_m_, axes);
  bool moved = false;
  for (const MinimumTranslation& axis : axes) moved = moveTo(axis.features) || moved;
  return moved;
}

// Between almost parallel features a step on one body alone gains less than rounding (half the slope
// squared), a step on both together gains the slope itself.
bool FeatureWalk::moveAlongBoth(const Vec3& n, const Vec3& minus_n_B) {
  const double level_sine = kLevelSine * std::sqrt(std::max(1.0, size_m_ / here().distance()));
  const LevelNeighbours on_a(pair_.a, here().features.a, n, level_sine);
  const LevelNeighbours on_b(pair_.b, here().features.b, minus_n_B, level_sine);
  bool moved = false;
  for (const Feature a : on_a.all())
    for (const Feature b : on_b.all())
      if (a.kind != FeatureKind::kFace || b.kind != FeatureKind::kFace) moved = moveTo({a, b}) || moved;
  return moved;
}

}  // namespace carom
