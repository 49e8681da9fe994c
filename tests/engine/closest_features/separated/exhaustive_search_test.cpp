// The fallback against long-double brute force, and on bodies that intersect in every way they can.

#include <gtest/gtest.h>

#include "engine/closest_features/separated/exhaustive_search.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

TEST(ExhaustiveSearch, GivesTheDistanceOfBruteForce) {
  oracle::Random random(3201);
  int apart = 0;
  for (int i = 0; i < 200; ++i) {
    const ConvexPart a{oracle::randomHull(random, 8 + i % 20), 0.0}, b{oracle::randomHull(random, 12), 0.0};
    const Vec3 position = 1.7 * random.direction();
    const Pose X_WA, X_WB{random.rotation(), position};
    const FeatureDistance found = exhaustiveSearch(PolyhedronPair(a.core, X_WA, b.core, X_WB));
    const double want =
        static_cast<double>(oracle::signedGap(oracle::place(a, X_WA), oracle::place(b, X_WB)));
    ASSERT_EQ(found.crossing, want < 0.0) << i;
    if (found.crossing) continue;
    ++apart;
    ASSERT_NEAR(found.distance(), want, 1e-14) << i;
    ASSERT_NEAR((found.p_b - found.p_a).norm(), want, 1e-14) << i;
  }
  EXPECT_GT(apart, 20);
  EXPECT_LT(apart, 180);
}

// Under the tip of a hull, which ends edges as well, and under a point, which ends none.
TEST(ExhaustiveSearch, FindsEveryFaceOfEither) {
  oracle::Random random(3202);
  const ConvexPolyhedron box = boxPolyhedron({1, 2, 3});
  for (const ConvexPolyhedron& tip :
       {oracle::randomHull(random, 8), ConvexPolyhedron::point(0.3 * random.direction())})
    for (int f = 0; f < box.faceCount(); ++f) {
      Vec3 middle = Vec3::Zero();
      for (const int v : box.faceVertices(f)) middle += 0.25 * box.vertex(v);
      const Vec3& n = box.plane(f).normal;
      const Vec3& lowest = tip.vertex(tip.support(-n));
      const Pose X_WT{Quat::Identity(), middle + 0.1 * n - lowest};
      EXPECT_EQ(exhaustiveSearch(PolyhedronPair(box, Pose(), tip, X_WT)).features.a, faceFeature(f));
      EXPECT_EQ(exhaustiveSearch(PolyhedronPair(tip, X_WT, box, Pose())).features.b, faceFeature(f));
    }
}

// No feature of one is near any of the other.
TEST(ExhaustiveSearch, OfABodyInsideAnother_IsACrossing) {
  const ConvexPolyhedron large = boxPolyhedron({10, 10, 10}), small = boxPolyhedron({1, 1, 1});
  const Pose X_WL, X_WS{oracle::turned({1, 2, 3}, 0.5), Vec3(1, 2, -3)};
  EXPECT_TRUE(exhaustiveSearch(PolyhedronPair(large, X_WL, small, X_WS)).crossing);
  EXPECT_TRUE(exhaustiveSearch(PolyhedronPair(small, X_WS, large, X_WL)).crossing);
}

TEST(ExhaustiveSearch, OfAPointAndASegment_IsTheirDistance) {
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1});
  const ConvexPolyhedron point = ConvexPolyhedron::point(Vec3::Zero());
  const FeatureDistance beside =
      exhaustiveSearch(PolyhedronPair(segment, Pose(), point, {Quat::Identity(), Vec3(0.5, 0, 0.25)}));
  EXPECT_FALSE(beside.crossing);
  EXPECT_DOUBLE_EQ(beside.distance(), 0.5);
  EXPECT_EQ(beside.features.a.kind, FeatureKind::kEdge);
}

// The second one's only edge is nearest to a point, and goes through a box that no end of it is in.
TEST(ExhaustiveSearch, OfASegmentAsTheSecond_SeesItsOnlyEdge) {
  const ConvexPolyhedron segment = ConvexPolyhedron::segment({0, 0, -2}, {0, 0, 2});
  const ConvexPolyhedron point = ConvexPolyhedron::point(Vec3::Zero()), box = boxPolyhedron({1, 1, 1});
  const FeatureDistance beside =
      exhaustiveSearch(PolyhedronPair(point, {Quat::Identity(), Vec3(0.5, 0, 0.25)}, segment, Pose()));
  EXPECT_FALSE(beside.crossing);
  EXPECT_DOUBLE_EQ(beside.distance(), 0.5);
  EXPECT_EQ(beside.features.b.kind, FeatureKind::kEdge);
  EXPECT_TRUE(exhaustiveSearch(PolyhedronPair(box, Pose(), segment, Pose())).crossing);
  EXPECT_TRUE(exhaustiveSearch(PolyhedronPair(segment, Pose(), box, Pose())).crossing);
}

}  // namespace
}  // namespace carom
