// The question whether last time's features are still the closest, against trying all features; and queries
// from memories that are right, stale, or another pair's: the answer is that of a query without memory.
// Seeds 7400 to 7420.

#include "engine/closest_features/separated/warm_pair.h"

#include <gtest/gtest.h>

#include "engine/closest_features/penetrating/penetration.h"
#include "engine/closest_features/vclip.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/support/build_effort.h"
#include "tests/support/features.h"

namespace carom {
namespace {

using oracle::Family;
using oracle::PosedPair;
using oracle::Random;

constexpr int kShare = inThisBuild(1, 20);

double fourUlp(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB) {
  return 4.0 * std::numeric_limits<double>::epsilon() *
         (sizeOf({a.core, X_WA, b.core, X_WB}) + a.radius_m + b.radius_m);
}

Feature anyFeature(const ConvexPolyhedron& p, Random& random) {
  const int i = random.integer(0, p.vertexCount() + p.edgeCount() + p.faceCount() - 1);
  if (i < p.vertexCount()) return vertexFeature(i);
  if (i < p.vertexCount() + p.edgeCount()) return edgeFeature(i - p.vertexCount());
  return faceFeature(i - p.vertexCount() - p.edgeCount());
}

// ---- the question itself ----

// Two polyhedra in place, seen from the origin of the first.
struct Placed {
  Placed(const ConvexPolyhedron& pa, const Pose& X_WA, const ConvexPolyhedron& pb, const Pose& X_WB)
      : a(pa, X_WA.rotation, Vec3::Zero()),
        b(pb, X_WB.rotation, X_WB.position - X_WA.position),
        noise_m(0x1p-47 * sizeOf({pa, X_WA, pb, X_WB})) {}

  PlacedPolyhedron a, b;
  double noise_m;
};

struct Claims {
  int count = 0;
  FeaturePair features;
  PlacedGap gap;
};

Claims claimsOverAllPairs(const Placed& placed) {
  Claims claims;
  for (const Feature a : allFeatures(placed.a.polyhedron))
    for (const Feature b : allFeatures(placed.b.polyhedron)) {
      PlacedGap gap;
      if (!certifiedClosest(placed.a, placed.b, {a, b}, placed.noise_m, gap)) continue;
      ++claims.count;
      claims.features = {a, b};
      claims.gap = gap;
    }
  return claims;
}

// How far a point, as the polyhedron is placed, is outside of it at most.
double outside(const PlacedPolyhedron& placed, const Vec3& p) {
  double most = -1e300;
  for (int f = 0; f < placed.polyhedron.faceCount(); ++f)
    most = std::max(most, placed.polyhedron.plane(f).signedDistance(placed.pointBack(p)));
  return most;
}

TEST(CertifiedClosest, IsOnePairOfAllInAGeneralPose_AndItsDistanceIsTheBruteForceOne) {
  Random random(7400);
  int separated = 0, silent = 0;
  for (int i = 0; i < 600 / kShare; ++i) {
    const ConvexPart a{oracle::randomHull(random, random.integer(4, 12)), 0.0};
    const ConvexPart b{oracle::randomHull(random, random.integer(4, 12)), 0.0};
    const Pose X_WA = random.pose(0.5);
    const Pose X_WB{random.rotation(), X_WA.position + random.uniform(1.0, 4.0) * random.direction()};
    const oracle::PlacedConvex pa = oracle::place(a, X_WA), pb = oracle::place(b, X_WB);
    const Placed placed(a.core, X_WA, b.core, X_WB);
    const double noise = placed.noise_m;
    const auto want = static_cast<double>(oracle::signedGap(pa, pb));
    if (want < 1e-6) continue;
    ++separated;
    const Claims claims = claimsOverAllPairs(placed);
    ASSERT_LE(claims.count, 1) << i;
    silent += claims.count == 0;
    if (claims.count == 0) continue;
    const PlacedGap& gap = claims.gap;
    ASSERT_NEAR(gap.length_m, want, 2.0 * noise) << i;
    const Vec3& n_W = gap.normal;
    ASSERT_NEAR(static_cast<double>(oracle::gapAlong(pa, pb, n_W.cast<oracle::Real>())), want, 4.0 * noise)
        << i;
    ASSERT_NEAR(outside(placed.a, gap.p_a), 0.0, 2.0 * noise) << i;
    ASSERT_NEAR(outside(placed.b, gap.p_a + gap.length_m * gap.normal), 0.0, 2.0 * noise) << i;
  }
  EXPECT_GT(separated, 300 / kShare);
  EXPECT_EQ(silent, 0) << "general poses in which no pair was found clear";
}

TEST(CertifiedClosest, IsNoPairOfBodiesThatIntersect) {
  Random random(7401);
  int penetrating = 0;
  for (int i = 0; i < 400 / kShare; ++i) {
    const ConvexPolyhedron a = oracle::randomHull(random, random.integer(4, 12));
    const ConvexPolyhedron b = oracle::randomHull(random, random.integer(4, 12));
    const Pose X_WA = random.pose(0.5), X_WB = random.pose(0.5);
    if (largestGap({a, X_WA, b, X_WB}).gap_m > -1e-9) continue;
    ++penetrating;
    ASSERT_EQ(claimsOverAllPairs({a, X_WA, b, X_WB}).count, 0) << i;
  }
  EXPECT_GT(penetrating, 200 / kShare);
}

// Where several pairs are equally near none of them is clear: face over face, edge over face, parallel edges.
TEST(CertifiedClosest, IsNoPairInALevelPose) {
  const ConvexPolyhedron box = boxPolyhedron({1, 1, 1});
  const auto claimed = [&](const Quat& rotation, const Vec3& position) {
    return claimsOverAllPairs({box, Pose{}, box, {rotation, position}}).count;
  };
  const Quat eighth = oracle::turned(Vec3::UnitX(), std::numbers::pi / 4);
  EXPECT_EQ(claimed(Quat::Identity(), Vec3(0.3, 0.2, 1.5)), 0) << "face over face";
  EXPECT_EQ(claimed(eighth, Vec3(0.3, 0.0, 2.0)), 0) << "edge over face";
  EXPECT_EQ(claimed(Quat::Identity(), Vec3(0.3, 1.5, 1.5)), 0) << "parallel edges";
  EXPECT_EQ(claimed(Quat::Identity(), Vec3(1.0, 0.2, 1.5)), 0) << "border to border";
}

// Whatever the start, what is found is what is clear of all pairs.
TEST(FindCertifiedClosest, FromAnyFeaturesFindsThePairThatIsClear_OrNone) {
  Random random(7403);
  int found = 0, stopped = 0;  // from what faces each other
  for (int i = 0; i < 400 / kShare; ++i) {
    const ConvexPolyhedron a = oracle::randomHull(random, random.integer(4, 12));
    const ConvexPolyhedron b = i % 10 == 0   ? ConvexPolyhedron::point(Vec3(0.1, 0.2, 0.3))
                               : i % 10 == 1 ? ConvexPolyhedron::segment(Vec3(-0.4, 0, 0), Vec3(0.4, 0, 0))
                                             : oracle::randomHull(random, random.integer(4, 12));
    const Pose X_WA = random.pose(0.5);
    const Pose X_WB{random.rotation(), X_WA.position + random.uniform(0.0, 4.0) * random.direction()};
    const Placed placed(a, X_WA, b, X_WB);
    const Claims claims = claimsOverAllPairs(placed);
    for (int k = 0; k < 20; ++k) {
      FeaturePair features = k == 0 ? facingFeatures(placed.a, placed.b)
                                    : FeaturePair{anyFeature(a, random), anyFeature(b, random)};
      const FeaturePair start = features;
      PlacedGap gap;
      const auto [visited, is_clear] =
          findCertifiedClosest(placed.a, placed.b, placed.noise_m, features, gap);
      ASSERT_GE(visited, 1);
      ASSERT_LE(visited, 8);
      (is_clear ? found : stopped) += k == 0 && claims.count == 1;
      if (!is_clear) continue;
      ASSERT_EQ(claims.count, 1) << i << ' ' << k;
      ASSERT_EQ(features, claims.features) << i << ' ' << k;
      ASSERT_EQ(visited == 1, features == start) << i << ' ' << k;
      ASSERT_EQ(gap.length_m, claims.gap.length_m) << i << ' ' << k;
      ASSERT_EQ(gap.normal, claims.gap.normal) << i << ' ' << k;
      ASSERT_EQ(gap.p_a, claims.gap.p_a) << i << ' ' << k;
    }
  }
  EXPECT_GT(found, 200 / kShare);
  EXPECT_LT(stopped, found / 20);
}

// Of round bodies that have turned: from features on the far sides one visit more than from the facing ones.
TEST(FindCertifiedClosest, FromFeaturesThatHaveTurnedAway_GoesOnFromThoseThatFace) {
  Random random(7419);
  const ConvexPolyhedron ball = oracle::randomHull(random, 250);
  int visited = 0, visited_facing = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X_WA = random.pose(0.5);
    const Pose X_WB{random.rotation(), X_WA.position + random.uniform(2.2, 4.0) * random.direction()};
    const Placed placed(ball, X_WA, ball, X_WB);
    const Vec3 between = X_WB.position - X_WA.position;
    FeaturePair facing = facingFeatures(placed.a, placed.b);
    FeaturePair averted{vertexFeature(ball.support(-placed.a.directionBack(between))),
                        vertexFeature(ball.support(placed.b.directionBack(between)))};
    PlacedGap gap;
    visited_facing += findCertifiedClosest(placed.a, placed.b, placed.noise_m, facing, gap).visited;
    visited += findCertifiedClosest(placed.a, placed.b, placed.noise_m, averted, gap).visited;
  }
  EXPECT_LE(visited, visited_facing + 200);
}

// Slabs of all facets afresh: the named features are the only ones that touch the planes of the depth.
TEST(CertifiedAlone, IsNeverSaidOfFeaturesThatOthersAreLevelWith) {
  Random random(7402);
  int alone = 0, penetrating = 0;
  for (int i = 0; i < 2000 / kShare; ++i) {
    const bool level = i % 4 == 0;
    const ConvexPolyhedron a = level ? boxPolyhedron({1, 1, 1}) : oracle::randomHull(random, 12);
    const ConvexPolyhedron b = level ? boxPolyhedron({1, 1, 1}) : oracle::randomHull(random, 12);
    Pose X_WA = random.pose(0.5), X_WB = random.pose(0.5);
    if (level) X_WB.rotation = X_WA.rotation;
    const PolyhedronPair pair(a, X_WA, b, X_WB);
    const double noise = 0x1p-47 * sizeOf(pair);
    const MinimumTranslation m = largestGap(pair);
    if (m.gap_m > -1e-9) continue;
    ++penetrating;
    const CoreAnswer answer{m.gap_m, m.normal, m.p_a, m.p_b, m.features};
    if (!certifiedInside(pair, answer, noise) || !certifiedAlone(pair, answer, noise)) continue;
    ++alone;
    ASSERT_FALSE(level) << i;
    const auto touching = [&](const ConvexPolyhedron& p, const Vec3& n) {
      double most = -1e300;
      for (const Vec3& v : p.vertices()) most = std::max(most, n.dot(v));
      return std::count_if(p.vertices().begin(), p.vertices().end(),
                           [&](const Vec3& v) { return n.dot(v) > most - noise; });
    };
    const auto corners = [](const ConvexPolyhedron& p, Feature f) -> std::ptrdiff_t {
      return f.kind == FeatureKind::kFace ? static_cast<std::ptrdiff_t>(p.faceVertices(f.index).size())
                                          : 1 + static_cast<std::ptrdiff_t>(f.kind);
    };
    ASSERT_EQ(touching(a, m.normal), corners(a, m.features.a)) << i;
    ASSERT_EQ(touching(b, -pair.directionToB(m.normal)), corners(b, m.features.b)) << i;
  }
  EXPECT_GT(alone, penetrating / 2);
}

// ---- queries from a memory ----

TEST(WarmQuery, OfFeaturesThatAreStillTheClosest_VisitsOnePair) {
  Random random(7410);
  int kept = 0, changed = 0;
  for (int run = 0; run < 20; ++run) {
    const ConvexPart a{oracle::randomHull(random, random.integer(8, 252)), 0.0};
    const ConvexPart b{oracle::randomHull(random, random.integer(8, 252)), 0.0};
    const Pose X_WA = random.pose(1.0);
    PairMemory memory;
    FeaturePair last;
    const Vec3 axis = random.direction();
    const Vec3 to_b = random.direction();
    for (int i = 0; i < 2000 / kShare; ++i) {
      const Pose X_WB{oracle::turned(axis, 1e-3 * i) * X_WA.rotation,
                      X_WA.position + 2.5 * (oracle::turned(axis, 0.7e-3 * i) * to_b)};
      const ClosestFeatures c = closestFeatures(a, X_WA, b, X_WB, memory);
      ASSERT_EQ(c.status, Separation::kSeparated);
      if (i > 0 && c.features == last) {
        ++kept;
        ASSERT_EQ(c.states, 1) << run << ", step " << i;
      } else {
        ++changed;
        ASSERT_LE(c.states, 13) << "in place and by a walk, " << run << ", step " << i;
      }
      last = c.features;
    }
  }
  EXPECT_GT(kept, 30000 / kShare);
  EXPECT_GT(changed, 300 / kShare);
}

// Between almost parallel features the distance falls in the second order of what is still to walk, below the
// rounding of its square: there a walk may end anywhere within the query's own noise, 32 ulp.
double asGoodAs(Family family, const PosedPair& p) {
  return (family == Family::kNearlyParallel ? 8.0 : 1.0) * fourUlp(*p.a, p.X_WA, *p.b, p.X_WB);
}

class AnyStart : public testing::TestWithParam<int> {};

// Any feature pair of the two parts, over poses of all families.
TEST_P(AnyStart, GivesTheColdAnswer) {
  const auto family = static_cast<Family>(GetParam());
  oracle::AdversarialPairs pairs(7411);
  Random random(7412);
  for (int i = 0; i < 400 / kShare; ++i) {
    const PosedPair p = pairs.next(family);
    PairMemory none;
    const ClosestFeatures cold = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, none);
    for (int k = 0; k < 10; ++k) {
      PairMemory stale;
      stale.features = {anyFeature(p.a->core, random), anyFeature(p.b->core, random)};
      const ClosestFeatures c = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, stale);
      ASSERT_EQ(c.status, cold.status) << oracle::familyName(family) << ' ' << i << ' ' << k;
      ASSERT_NEAR(c.distance_m, cold.distance_m, asGoodAs(family, p))
          << oracle::familyName(family) << ' ' << i << ' ' << k;
      ASSERT_FALSE(c.reached_limit) << oracle::familyName(family) << ' ' << i << ' ' << k;
    }
  }
}
std::string nameOf(const testing::TestParamInfo<int>& family) {
  std::string name = oracle::familyName(static_cast<Family>(family.param));
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Families, AnyStart, testing::Range(0, static_cast<int>(Family::kCount)), nameOf);

TEST(StaleMemory, OfAPoseAnyJumpAgo_GivesTheColdAnswer) {
  Random random(7413);
  int met = 0, parted = 0;
  for (int run = 0; run < 50; ++run) {
    const ConvexPart a{oracle::randomHull(random, random.integer(4, 62)), 0.0};
    const ConvexPart b{oracle::randomHull(random, random.integer(4, 62)), 0.0};
    PairMemory memory;
    bool was_inside = false;
    for (int i = 0; i < 200 / kShare; ++i) {
      const Pose X_WA = random.pose(0.5);
      const Pose X_WB{random.rotation(), X_WA.position + random.uniform(0.0, 3.0) * random.direction()};
      const ClosestFeatures c = closestFeatures(a, X_WA, b, X_WB, memory);
      PairMemory none;
      const ClosestFeatures cold = closestFeatures(a, X_WA, b, X_WB, none);
      const bool inside = cold.status == Separation::kPenetrating;
      ASSERT_EQ(c.status, cold.status) << run << ", jump " << i;
      ASSERT_NEAR(c.distance_m, cold.distance_m, fourUlp(a, X_WA, b, X_WB)) << run << ", jump " << i;
      met += inside && !was_inside;
      parted += was_inside && !inside;
      was_inside = inside;
    }
  }
  EXPECT_GT(met, 1000 / kShare);
  EXPECT_GT(parted, 1000 / kShare);
}

// The penetration of other bodies in the memory is only their answer's features and a polytope whose corners
// are vertices of theirs: with as many vertices, edges and faces here it names what exists, and is stale.
TEST(StaleMemory, OfOtherBodiesWithAsManyFeatures_GivesTheColdAnswer) {
  Random random(7414);
  std::vector<ConvexPart> parts;
  while (parts.size() < 12) {
    const ConvexPart part{oracle::randomHull(random, 20), 0.0};
    if (parts.empty() || part.core.edgeCount() == parts[0].core.edgeCount()) parts.push_back(part);
  }
  PairMemory memory;
  for (int i = 0; i < 5000 / kShare; ++i) {
    const ConvexPart& a = parts[static_cast<std::size_t>(random.integer(0, 11))];
    const ConvexPart& b = parts[static_cast<std::size_t>(random.integer(0, 11))];
    const Pose X_WA = random.pose(0.5);
    const Pose X_WB{random.rotation(), X_WA.position + random.uniform(0.0, 2.5) * random.direction()};
    const ClosestFeatures c = closestFeatures(a, X_WA, b, X_WB, memory);
    PairMemory none;
    const ClosestFeatures cold = closestFeatures(a, X_WA, b, X_WB, none);
    ASSERT_EQ(c.status, cold.status) << i;
    ASSERT_NEAR(c.distance_m, cold.distance_m, fourUlp(a, X_WA, b, X_WB)) << i;
  }
}

TEST(StaleMemory, OfHalfAPair_IsAColdStart) {
  const ConvexPart box{boxPolyhedron({1, 1, 1}), 0.0};
  const Pose X_WB{oracle::turned(Vec3(1, 2, 3), 0.7), Vec3(0.2, 0.1, 2.0)};
  PairMemory none;
  const ClosestFeatures cold = closestFeatures(box, Pose{}, box, X_WB, none);
  for (const FeaturePair& half :
       {FeaturePair{Feature{}, faceFeature(3)}, FeaturePair{edgeFeature(7), Feature{}}}) {
    PairMemory memory;
    memory.features = half;
    const ClosestFeatures c = closestFeatures(box, Pose{}, box, X_WB, memory);
    EXPECT_EQ(c.distance_m, cold.distance_m);
    EXPECT_EQ(c.features, cold.features);
    EXPECT_EQ(c.states, cold.states);
    EXPECT_EQ(memory.features, cold.features);
  }
}

}  // namespace
}  // namespace carom
