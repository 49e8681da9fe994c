#pragma once
// Pairs of convex parts in poses that closest-feature algorithms are known to get wrong, and general ones
// beside them. The same seed gives the same pairs. Used by tests/engine/closest_features/.

#include <string>
#include <utility>

#include "tests/oracle/test_shapes.h"

namespace carom::oracle {

enum class Family {
  kGeneral,  ///< Random hulls of 8 to 250 vertices, from far apart to deep inside each other.
  kLattice,  ///< Boxes, plain and of triangles, on exact lattice poses: everything parallel, much of it
             ///< coplanar.
  kNearlyParallel,  ///< A face over a face, tilted by 1e-15 to 1e-3.
  kNeedles,         ///< Aspect ratios up to 1e4.
  kSizeRatio,       ///< 1e-3 against 100.
  kGons,            ///< Prisms and spikes over 200-gons: large faces, vertices of high degree.
  kNearlyFlat,      ///< Dihedral angles within 1e-8 to 1e-3 of flat.
  kShortEdges,      ///< Boxes whose corners are cut at 1e-8 to 1e-3 of their size.
  kTouching,        ///< Gaps of exactly or almost zero.
  kConcentric,      ///< Deep inside each other, many at the very same pose.
  kFarAway,         ///< 1e4 sizes from the origin.
  kDrifted,         ///< Rotations whose quaternions have drifted from unit length by up to 1e-12.
  kRounded,         ///< Balls and capsules among the polyhedra.
  kCount
};

inline const char* familyName(Family family) {
  static const char* names[] = {"general",  "lattice",     "nearly parallel", "needles",  "size ratio",
                                "gons",     "nearly flat", "short edges",     "touching", "concentric",
                                "far away", "drifted",     "rounded"};
  return names[static_cast<std::size_t>(family)];
}

struct PosedPair {
  const ConvexPart* a = nullptr;
  const ConvexPart* b = nullptr;
  Pose X_WA;
  Pose X_WB;

  /// A length that the pair's rounding is relative to, metres.
  double scale() const {
    const auto reach = [](const ConvexPart& part) {
      return part.core.radiusAbout(Vec3::Zero()) + part.radius_m;
    };
    return reach(*a) + reach(*b) + (X_WA.position - X_WB.position).norm();
  }
};

class AdversarialPairs {
 public:
  explicit AdversarialPairs(std::uint64_t seed) : random_(seed) { buildPopulation(); }

  PosedPair next(Family family) {
    switch (family) {
      case Family::kLattice:
        return latticePair();
      case Family::kNearlyParallel:
        return nearlyParallelPair();
      case Family::kNeedles:
        return looselyPosed(pick(needles_), coin() ? pick(needles_) : pick(small_));
      case Family::kSizeRatio:
        return swappedByChance(looselyPosed(pick(tiny_), pick(huge_)));
      case Family::kGons:
        return looselyPosed(pick(gons_), coin() ? pick(gons_) : pick(small_));
      case Family::kNearlyFlat:
        return looselyPosed(pick(flat_), coin() ? pick(flat_) : pick(boxes_));
      case Family::kShortEdges:
        return coin() ? stacked(pick(cut_), pick(cut_)) : looselyPosed(pick(cut_), pick(cut_));
      case Family::kTouching:
        return touchingPair();
      case Family::kConcentric:
        return concentricPair();
      case Family::kFarAway:
        return farAwayPair();
      case Family::kDrifted:
        return driftedPair();
      case Family::kRounded:
        return swappedByChance(looselyPosed(pick(rounded_), coin() ? pick(rounded_) : pick(small_)));
      default:
        return generalPair();
    }
  }
  /// A pair of random hulls of at most 20 vertices: cheap for exhaustive oracles.
  PosedPair nextSmall() { return looselyPosed(pick(small_), pick(small_)); }

  Random& random() { return random_; }

 private:
  using Parts = std::vector<ConvexPart>;

  bool coin() { return random_.integer(0, 1) == 1; }
  const ConvexPart& pick(const Parts& parts) {
    return parts[static_cast<std::size_t>(random_.integer(0, static_cast<int>(parts.size()) - 1))];
  }
  static double reach(const ConvexPart& part) { return part.core.radiusAbout(Vec3::Zero()) + part.radius_m; }

  static void add(Parts& parts, ConvexPolyhedron core, double radius_m = 0.0) {
    parts.push_back({std::move(core), radius_m});
  }
  static ConvexPolyhedron scaled(const ConvexPolyhedron& p, double factor) {
    std::vector<Vec3> vertices;
    for (const Vec3& v : p.vertices()) vertices.push_back(factor * v);
    return convexHull(vertices).polyhedron;
  }

  void buildPopulation() {
    for (int n : {8, 9, 10, 12, 14, 16, 18, 20}) {
      add(small_, randomHull(random_, n));
      add(small_, randomHull(random_, n, Vec3(1, 0.6, 0.2)));
    }
    add(small_, dodecahedron());
    add(small_, icosahedron());
    add(small_, octahedron());
    add(small_, tetrahedron());
    for (int n : {32, 62, 100, 160, 252})
      add(large_, randomHull(random_, n, Vec3(1, random_.uniform(0.3, 1), random_.uniform(0.3, 1))));
    for (const Vec3& size : {Vec3(1, 1, 1), Vec3(1, 2, 1), Vec3(0.5, 1, 0.25), Vec3(2, 2, 0.5)}) {
      add(boxes_, boxPolyhedron(size));
      add(boxes_, triangulatedBox(size));
    }
    add(needles_, boxPolyhedron({1, 1e-4, 1e-4}));
    add(needles_, boxPolyhedron({1, 1, 1e-4}));
    add(needles_, randomHull(random_, 12, Vec3(1, 1e-4, 1e-4)));
    add(needles_, randomHull(random_, 20, Vec3(1, 1e-2, 1e-4)));
    add(needles_, scaled(prism(12, 1.0, 1e4), 1e-4));
    add(tiny_, boxPolyhedron({1e-3, 2e-3, 1e-3}));
    add(tiny_, scaled(dodecahedron(), 1e-3));
    add(huge_, boxPolyhedron({100, 100, 50}));
    add(huge_, scaled(randomHull(random_, 30), 100.0));
    add(gons_, prism(200, 1.0, 0.5));
    add(gons_, prism(60, 0.5, 2.0));
    std::vector<Vec3> spike = prism(200, 1.0, 0.5).vertices();
    spike.resize(200);
    spike.emplace_back(0, 0, 1);
    add(gons_, convexHull(spike).polyhedron);
    for (double bulge : {1e-3, 1e-5, 1e-7, 1e-8}) {
      add(flat_, bulgingBox(bulge));
      add(cut_, cutBox(bulge));
    }
    add(rounded_, ConvexPolyhedron::point(Vec3::Zero()), 0.5);
    add(rounded_, ConvexPolyhedron::point(Vec3(0.1, 0.2, 0.3)), 1e-3);
    add(rounded_, ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.3);
    add(rounded_, ConvexPolyhedron::segment({0, -0.1, 0}, {0, 0.3, 0}), 0.1);
  }

  // The unit box with the middle of each face raised.
  static ConvexPolyhedron bulgingBox(double bulge) {
    std::vector<Vec3> points = boxPolyhedron(Vec3::Ones()).vertices();
    for (int axis = 0; axis < 3; ++axis)
      for (double side : {-1.0, 1.0}) points.push_back(side * (0.5 + bulge) * Vec3::Unit(axis));
    return convexHull(points).polyhedron;
  }

  // The unit box with each corner cut off by a small triangle.
  static ConvexPolyhedron cutBox(double cut) {
    std::vector<Vec3> points;
    const ConvexPolyhedron box = boxPolyhedron(Vec3::Ones());
    for (const Vec3& v : box.vertices())
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 p = v;
        p[axis] *= 1.0 - 2.0 * cut;
        points.push_back(p);
      }
    return convexHull(points).polyhedron;
  }

  // From deep overlap to several sizes apart, in any orientation.
  PosedPair looselyPosed(const ConvexPart& a, const ConvexPart& b) {
    PosedPair pair{&a, &b, random_.pose(0.5), Pose{}};
    const double reaches = reach(a) + reach(b);
    const double between = coin() ? random_.uniform(0.2, 1.1) * reaches : random_.uniform(1.0, 3.0) * reaches;
    pair.X_WB = {random_.rotation(), pair.X_WA.position + between * random_.direction()};
    return pair;
  }

  PosedPair swappedByChance(PosedPair pair) {
    if (coin()) {
      std::swap(pair.a, pair.b);
      std::swap(pair.X_WA, pair.X_WB);
    }
    return pair;
  }

  PosedPair generalPair() {
    if (random_.integer(0, 9) > 0) return nextSmall();
    return looselyPosed(pick(large_), coin() ? pick(large_) : pick(small_));
  }

  Quat quarterTurns() {
    const double quarter = std::numbers::pi / 2;
    const Quat q = turned(Vec3::UnitZ(), quarter * random_.integer(0, 3)) *
                   turned(Vec3::UnitX(), quarter * random_.integer(0, 3));
    return q * turned(Vec3::UnitY(), quarter * random_.integer(0, 3));
  }

  PosedPair latticePair() {
    const auto step = [&] { return 0.125 * random_.integer(-14, 14); };
    PosedPair pair{&pick(boxes_), &pick(boxes_), Pose{}, Pose{}};
    pair.X_WA.rotation = quarterTurns();
    pair.X_WB = {quarterTurns(), Vec3(step(), step(), step())};
    if (random_.integer(0, 3) == 0)
      pair.X_WB.rotation = turned(Vec3::UnitZ(), std::numbers::pi / 4) * pair.X_WB.rotation;
    return pair;
  }

  // B over A along z, turned about z, with a small gap and a small tilt.
  PosedPair stacked(const ConvexPart& a, const ConvexPart& b) {
    const double tilt = random_.logUniform(1e-15, 1e-3);
    const double spin = coin() ? 0.0 : random_.uniform(0.0, 6.3);
    PosedPair pair{&a, &b, Pose{}, Pose{}};
    pair.X_WB.rotation = turned(random_.direction(), tilt) * turned(Vec3::UnitZ(), spin);
    double top = 0.0, bottom = 0.0;
    for (const Vec3& v : a.core.vertices()) top = std::max(top, v.z());
    for (const Vec3& v : b.core.vertices()) bottom = std::min(bottom, (pair.X_WB.rotation * v).z());
    const bool aligned = coin();  // corner over corner, or shifted
    pair.X_WB.position = Vec3(aligned ? 0.0 : random_.uniform(-1, 1), aligned ? 0.0 : random_.uniform(-1, 1),
                              top - bottom + random_.logUniform(1e-6, 1.0));
    const Pose X = coin() ? Pose{} : random_.pose(1.0);
    pair.X_WA = X * pair.X_WA;
    pair.X_WB = X * pair.X_WB;
    return pair;
  }

  PosedPair nearlyParallelPair() {
    const Parts& with = coin() ? boxes_ : gons_;
    return stacked(pick(boxes_), pick(with));
  }

  PosedPair touchingPair() {
    PosedPair pair = stacked(pick(boxes_), pick(boxes_));
    const Vec3 up = pair.X_WA.rotation * Vec3::UnitZ();
    double top = -1e9, bottom = 1e9;
    for (const Vec3& v : pair.a->core.vertices()) top = std::max(top, up.dot(pair.X_WA * v));
    for (const Vec3& v : pair.b->core.vertices()) bottom = std::min(bottom, up.dot(pair.X_WB * v));
    const double gap = coin() ? 0.0 : (coin() ? 1.0 : -1.0) * random_.logUniform(1e-17, 1e-7);
    pair.X_WB.position += (top - bottom + gap) * up;
    return pair;
  }

  PosedPair concentricPair() {
    const ConvexPart& a = coin() ? pick(small_) : pick(boxes_);
    const ConvexPart& b = coin() ? a : pick(boxes_);
    PosedPair pair{&a, &b, random_.pose(1.0), Pose{}};
    pair.X_WB = pair.X_WA;
    if (coin()) pair.X_WB.position += random_.logUniform(1e-16, 1e-1) * random_.direction();
    if (coin())
      pair.X_WB.rotation =
          (pair.X_WB.rotation * turned(random_.direction(), random_.logUniform(1e-16, 1.0))).normalized();
    return pair;
  }

  PosedPair farAwayPair() {
    PosedPair pair = coin() ? nextSmall() : latticePair();
    const Vec3 away(1e4, -2e4, 5e3);
    pair.X_WA.position += away;
    pair.X_WB.position += away;
    return pair;
  }

  PosedPair driftedPair() {
    PosedPair pair = coin() ? nextSmall() : latticePair();
    pair.X_WA.rotation.coeffs() *= 1.0 + random_.logUniform(1e-16, 1e-12);
    pair.X_WB.rotation.coeffs() *= 1.0 - random_.logUniform(1e-16, 1e-12);
    return pair;
  }

  Random random_;
  Parts small_, large_, boxes_, needles_, tiny_, huge_, gons_, flat_, cut_, rounded_;
};

}  // namespace carom::oracle
