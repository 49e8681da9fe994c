// A facet that is said to be nearest is, against the full search over the separating axes, whatever facet the
// descent begins at; and motion of round bodies is answered by it nearly always, however deep they overlap.
// Seeds 7600, 7601, 7604 and 7605.

#include "engine/closest_features/penetrating/warm_facet.h"

#include <gtest/gtest.h>

#include "engine/closest_features/certificate.h"
#include "engine/closest_features/vclip.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"
#include "tests/support/features.h"

namespace carom {
namespace {

using oracle::Random;

constexpr int kPoses = inThisBuild(60, 4);

double noiseOf(const PolyhedronPair& pair) {
  return 0x1p-47 * sizeOf(pair);
}

std::vector<ConvexPolyhedron> shapes(Random& random) {
  return {boxPolyhedron({1, 1, 1}),
          boxPolyhedron({2, 0.3, 0.6}),
          oracle::tetrahedron(),
          oracle::octahedron(),
          oracle::dodecahedron(),
          oracle::triangulatedBox({1, 0.8, 0.6}),
          oracle::prism(6, 0.5, 0.2),
          oracle::prism(20, 0.5, 1.0),
          oracle::randomHull(random, 9, Vec3(1, 0.6, 0.05)),
          oracle::randomHull(random, 14),
          oracle::randomHull(random, 32, Vec3(1, 0.5, 0.7)),
          ConvexPolyhedron::point(Vec3(0.1, 0.0, 0.0)),
          ConvexPolyhedron::segment(Vec3(0, 0, -0.5), Vec3(0, 0, 0.5))};
}

// Every pair of features that could make a facet, or some of very many.
std::vector<FeaturePair> seeds(const PolyhedronPair& pair, Random& random) {
  std::vector<FeaturePair> all;
  for (int f = 0; f < pair.a.faceCount(); ++f)
    for (int v = 0; v < pair.b.vertexCount(); ++v) all.push_back({faceFeature(f), vertexFeature(v)});
  for (int v = 0; v < pair.a.vertexCount(); ++v)
    for (int f = 0; f < pair.b.faceCount(); ++f) all.push_back({vertexFeature(v), faceFeature(f)});
  for (int e = 0; e < pair.a.edgeCount(); ++e)
    for (int g = 0; g < pair.b.edgeCount(); ++g) all.push_back({edgeFeature(e), edgeFeature(g)});
  constexpr int kMost = 200;
  const int count = static_cast<int>(all.size());
  if (count <= kMost) return all;
  std::vector<FeaturePair> some;
  for (int i = 0; i < kMost; ++i) some.push_back(all[static_cast<std::size_t>(random.integer(0, count - 1))]);
  return some;
}

double gapAlong(const PolyhedronPair& pair, const Vec3& n) {
  double highest_of_a = -1e300, lowest_of_b = 1e300;
  for (const Vec3& v : pair.a.vertices()) highest_of_a = std::max(highest_of_a, n.dot(v));
  for (const Vec3& v : pair.b.vertices()) lowest_of_b = std::min(lowest_of_b, n.dot(pair.toA(v)));
  return lowest_of_b - highest_of_a;
}

// What became of the descents, from all seeds at many poses of two shapes.
struct Outcomes {
  int descents = 0;
  int proven = 0;
};

Outcomes descend(const ConvexPolyhedron& a, const ConvexPolyhedron& b, double deepest, Random& random) {
  Outcomes outcomes;
  for (int i = 0; i < kPoses; ++i) {
    const ConvexPart part_a{a, 0.0}, part_b{b, 0.0};
    Pose X_WA = random.pose(0.3), X_WB = random.pose(0.3);
    // Together along the gap, then on to a depth.
    FeaturePair tracked;
    const ClosestFeatures apart = closestFeatures(part_a, X_WA, part_b, X_WB, tracked);
    X_WB.position -= (apart.distance_m + deepest * random.uniform(0.0, 1.0)) * apart.n_W;
    const PolyhedronPair pair(a, X_WA, b, X_WB);
    const MinimumTranslation best = largestGap(pair);
    const double noise = noiseOf(pair);
    if (best.gap_m > -4.0 * noise) continue;
    for (const FeaturePair& seed : seeds(pair, random)) {
      const auto warm = nearestFacet(pair, seed, noise);
      if (!warm) continue;
      ++outcomes.descents;
      outcomes.proven += warm->proven;
      EXPECT_NEAR(warm->gap.gap_m, gapAlong(pair, warm->gap.normal), 2.0 * noise) << i;
      EXPECT_LE(warm->gap.gap_m, best.gap_m + 2.0 * noise) << i;
      const Vec3 between = warm->gap.p_b - warm->gap.p_a - warm->gap.gap_m * warm->gap.normal;
      EXPECT_LT(between.norm(), 2.0 * noise) << i;
      if (warm->proven) {
        EXPECT_NEAR(warm->gap.gap_m, best.gap_m, 2.0 * noise) << i;
      }
    }
  }
  return outcomes;
}

TEST(WarmFacet, ProvenFromAnySeed_IsTheFullSearch) {
  Random random(7600);
  const std::vector<ConvexPolyhedron> all = shapes(random);
  Outcomes sum;
  for (const ConvexPolyhedron& a : all)
    for (const ConvexPolyhedron& b : all) {
      if (a.faceCount() == 0 && b.faceCount() == 0) continue;
      for (const double deepest : {0.02, 0.5}) {
        const Outcomes outcomes = descend(a, b, deepest, random);
        if (testing::Test::HasFailure()) return;
        sum.descents += outcomes.descents;
        sum.proven += outcomes.proven;
      }
    }
  EXPECT_GT(sum.descents, 1000 * kPoses);
  EXPECT_GT(sum.proven, sum.descents / 20);
}

// Faces in pieces, parallel to one another: edges that are flat, vertices in the middle of faces, ties.
TEST(WarmFacet, ProvenInLatticePoses_IsTheFullSearch) {
  Random random(7605);
  const std::vector<ConvexPolyhedron> all = {boxPolyhedron({1, 1, 1}), oracle::triangulatedBox({1, 0.8, 0.6}),
                                             oracle::coplanarGrid(3, {0.6, 0.6, 0.6}), oracle::octahedron()};
  int descents = 0, proven = 0;
  for (const ConvexPolyhedron& a : all)
    for (const ConvexPolyhedron& b : all)
      for (int i = 0; i < 2 * kPoses; ++i) {
        Quat R = Quat::Identity();
        for (int turn = random.integer(0, 3); turn > 0; --turn)
          R = R * oracle::turned(Vec3::Unit(random.integer(0, 2)), 0.5 * std::numbers::pi);
        const Vec3 offset(random.integer(-8, 8), random.integer(-8, 8), random.integer(-8, 8));
        const PolyhedronPair pair(a, Pose{}, b, {R, 0.05 * offset});
        const MinimumTranslation best = largestGap(pair);
        const double noise = noiseOf(pair);
        if (best.gap_m > -4.0 * noise) continue;
        for (const FeaturePair& seed : seeds(pair, random)) {
          const auto warm = nearestFacet(pair, seed, noise);
          if (!warm) continue;
          ++descents;
          proven += warm->proven;
          ASSERT_LE(warm->gap.gap_m, best.gap_m + 2.0 * noise) << i;
          if (warm->proven) {
            ASSERT_NEAR(warm->gap.gap_m, best.gap_m, 2.0 * noise) << i;
          }
        }
      }
  EXPECT_GT(descents, 1000 * kPoses);
  EXPECT_GT(proven, descents / 50);
}

// Points on a sphere, each near its place on a spiral of equal areas.
ConvexPolyhedron roundHull(int n, Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / n, turn = 2.39996 * i;
    const Vec3 p(std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z);
    points.push_back(0.5 * (p + 0.1 / std::sqrt(n) * random.direction()).normalized());
  }
  return convexHull(points).polyhedron;
}

TEST(WarmFacet, OfRoundBodiesThatTurnInEachOther_IsProvenNearlyAlways) {
  Random random(7601);
  for (const int n : {20, 62, 252})
    for (const double apart : {n == 20 ? 0.85 : 0.93, 0.7, 0.5}) {
      const ConvexPart part{roundHull(n, random), 0.0};
      Pose X_WA, X_WB{random.rotation(), Vec3(apart, 0.05, 0.0)};
      PairMemory memory;
      closestFeatures(part, X_WA, part, X_WB, memory);
      int proven = 0;
      constexpr int kSteps = 400;
      for (int i = 0; i < kSteps; ++i) {
        X_WA.rotation = (oracle::turned(Vec3(1, 2, 3).normalized(), 0.017) * X_WA.rotation).normalized();
        X_WB.rotation = (oracle::turned(Vec3(-2, 1, 1).normalized(), 0.017) * X_WB.rotation).normalized();
        const PolyhedronPair pair(part.core, X_WA, part.core, X_WB);
        const auto warm = nearestFacet(pair, memory.features, noiseOf(pair));
        proven += warm && warm->proven;
        const ClosestFeatures c = closestFeatures(part, X_WA, part, X_WB, memory);
        ASSERT_EQ(c.status, Separation::kPenetrating) << n << ", step " << i;
        // What has been proven without the polytope is certified, and nothing deeper is.
        const Certificate right = certify(c, part, X_WA, part, X_WB, &memory);
        ASSERT_TRUE(right.complete) << n << ", step " << i;
        ASSERT_LE(right.error_m, certifiedError(part, X_WA, part, X_WB)) << n << ", step " << i;
      }
      EXPECT_GT(proven, kSteps * 9 / 10) << n << " at " << apart;
    }
}

// A small body just below a corner of a large one: all facets around it are local minima, almost equally
// near, and the one across the side next to the foot need not be the one that is nearer.
TEST(WarmFacet, ProvenBelowACorner_IsTheNearestOfThoseAroundIt) {
  Random random(7604);
  const std::vector<ConvexPolyhedron> large = {boxPolyhedron({1, 1, 1}), oracle::prism(7, 0.5, 0.8),
                                               roundHull(20, random), roundHull(62, random),
                                               roundHull(252, random)};
  const std::vector<ConvexPolyhedron> small = {ConvexPolyhedron::point(Vec3::Zero()),
                                               boxPolyhedron(Vec3::Constant(0.02)), roundHull(12, random)};
  int proven = 0, nearest = 0;
  for (const ConvexPolyhedron& a : large)
    for (std::size_t k = 0; k < small.size(); ++k)
      for (int i = 0; i < 20 * kPoses; ++i) {
        const ConvexPolyhedron& b = small[k];
        const int v = random.integer(0, a.vertexCount() - 1);
        const Vec3 below = random.logUniform(0.01, 0.3) * (a.center() - a.vertex(v));
        const Vec3 beside = random.logUniform(1e-3, 0.5) * below.norm() * random.direction();
        const PolyhedronPair pair(a, Pose{}, b, {random.rotation(), a.vertex(v) + below + beside});
        const MinimumTranslation best = largestGap(pair);
        const double noise = noiseOf(pair);
        if (best.gap_m > -4.0 * noise) continue;
        for (const Spoke& spoke : a.spokes(v)) {
          const FeaturePair seed{faceFeature(a.edge(spoke.edge).left), vertexFeature(0)};
          const auto warm = nearestFacet(pair, seed, noise);
          ASSERT_TRUE(warm);
          const bool is_nearest = warm->gap.gap_m > best.gap_m - 2.0 * noise;
          ASSERT_TRUE(is_nearest || !warm->proven)
              << i << ": " << -warm->gap.gap_m << " is said to be the depth " << -best.gap_m;
          proven += warm->proven;
          nearest += is_nearest;
        }
      }
  EXPECT_GT(nearest, 500 * kPoses);
  EXPECT_GT(proven, nearest / 20);
}

TEST(WarmFacet, OfFeaturesThatMakeNoFacet_IsNone) {
  const ConvexPolyhedron box = boxPolyhedron({1, 1, 1});
  const PolyhedronPair pair(box, Pose{}, box, {Quat::Identity(), Vec3(0.9, 0.1, 0.2)});
  EXPECT_FALSE(nearestFacet(pair, {vertexFeature(0), vertexFeature(1)}, noiseOf(pair)));
  EXPECT_FALSE(nearestFacet(pair, {}, noiseOf(pair)));
}

// Two unit cubes side by side, 0.1 into each other: of six faces of A, one is the way out, and the others
// that hold their foot are local minima, up to 1.9 deep.
TEST(WarmFacet, OfAFaceInAFace_IsProvenFromThatFaceAndNoOtherIs) {
  const ConvexPolyhedron box = boxPolyhedron({1, 1, 1});
  const PolyhedronPair pair(box, Pose{}, box,
                            {oracle::turned(Vec3(3, 1, 2).normalized(), 1e-3), Vec3(0.9, 0.1, 0.2)});
  int led_there = 0;
  for (int f = 0; f < 6; ++f) {
    const auto warm = nearestFacet(pair, {faceFeature(f), vertexFeature(0)}, noiseOf(pair));
    ASSERT_TRUE(warm) << f;
    EXPECT_EQ(warm->proven, warm->gap.gap_m > -0.11) << f;
    if (box.plane(f).normal.x() > 0.5) {
      EXPECT_TRUE(warm->proven) << f;
    }
    led_there += warm->proven;
  }
  EXPECT_GE(led_there, 3);
}

}  // namespace
}  // namespace carom
