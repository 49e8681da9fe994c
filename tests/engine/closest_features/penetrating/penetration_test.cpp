// The exact minimum translation: closed forms, and the full search over all separating axes.

#include "engine/closest_features/penetrating/penetration.h"

#include <gtest/gtest.h>

#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(MinimumTranslation, OfAlignedBoxes_IsTheLeastOverlap) {
  const ConvexPolyhedron box = boxPolyhedron({1, 1, 1});
  const MinimumTranslation m = largestGap({box, Pose{}, box, Pose{Quat::Identity(), Vec3(0.2, -0.7, 0.4)}});
  EXPECT_NEAR(m.gap_m, -0.3, 1e-15);
  EXPECT_LT((m.normal - Vec3(0, -1, 0)).norm(), 1e-15);
}

TEST(MinimumTranslation, OfCrossedEdges_IsAlongTheirCommonPerpendicular) {
  const ConvexPolyhedron box = boxPolyhedron({1, 1, 1});
  const Pose X_WA{oracle::turned(Vec3::UnitX(), std::numbers::pi / 4), Vec3::Zero()};
  const Pose X_WB{oracle::turned(Vec3::UnitY(), std::numbers::pi / 4), Vec3(0.1, 0.1, 1.3)};
  const MinimumTranslation m = largestGap({box, X_WA, box, X_WB});
  EXPECT_NEAR(m.gap_m, 1.3 - std::numbers::sqrt2, 1e-15);
  EXPECT_EQ(m.features.a.kind, FeatureKind::kEdge);
  EXPECT_EQ(m.features.b.kind, FeatureKind::kEdge);
  EXPECT_LT((X_WA.rotation * m.normal - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(MinimumTranslation, EqualsTheFullSearchOverTheSeparatingAxes) {
  Random random(61);
  int overlapping = 0;
  for (int i = 0; i < 1000; ++i) {
    const ConvexPolyhedron p =
        oracle::randomHull(random, random.integer(4, 16), Vec3(1, random.uniform(0.1, 1), 1));
    const ConvexPolyhedron q = oracle::randomHull(random, random.integer(4, 16));
    const Pose X_WA = random.pose(0.5), X_WB = random.pose(0.5);
    const MinimumTranslation m = largestGap({p, X_WA, q, X_WB});
    const oracle::PlacedConvex a = oracle::place({p, 0.0}, X_WA), b = oracle::place({q, 0.0}, X_WB);
    const oracle::Real want = oracle::largestAxisGap(a, b).gap_m;
    if (want >= 0) continue;
    ++overlapping;
    ASSERT_NEAR(m.gap_m, double(want), 1e-14) << i;
    const Vec3 n_W = X_WA.rotation * m.normal;
    ASSERT_NEAR(double(oracle::gapAlong(a, b, n_W.cast<oracle::Real>())), double(want), 1e-14)
        << "n separates by that depth";
    ASSERT_LT((m.p_b - m.p_a - m.gap_m * m.normal).norm(), 1e-14) << i;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(MinimumTranslation, OfLargeHulls_EqualsTheFullSearch) {
  Random random(62);
  for (int i = 0; i < 3; ++i) {
    const ConvexPolyhedron p = oracle::randomHull(random, 62),
                           q = oracle::randomHull(random, 62, Vec3(1, 0.5, 0.7));
    const Pose X_WA = random.pose(0.3), X_WB = random.pose(0.3);
    const oracle::Real want =
        oracle::largestAxisGap(oracle::place({p, 0.0}, X_WA), oracle::place({q, 0.0}, X_WB)).gap_m;
    EXPECT_NEAR(largestGap({p, X_WA, q, X_WB}).gap_m, double(want), 1e-14);
  }
}

TEST(MinimumTranslation, SwappingTheBodiesTurnsTheNormalRound) {
  Random random(63);
  for (int i = 0; i < 100; ++i) {
    const ConvexPolyhedron p = oracle::randomHull(random, 10), q = oracle::randomHull(random, 10);
    const Pose X_WA = random.pose(0.5), X_WB = random.pose(0.5);
    const MinimumTranslation ab = largestGap({p, X_WA, q, X_WB}), ba = largestGap({q, X_WB, p, X_WA});
    EXPECT_NEAR(ab.gap_m, ba.gap_m, 1e-14);
    EXPECT_LT((X_WA.rotation * ab.normal + X_WB.rotation * ba.normal).norm(), 1e-10);
  }
}

TEST(MinimumTranslation, OfASegmentInABox_LeavesByTheNearestFace) {
  const ConvexPolyhedron box = boxPolyhedron({2, 2, 2}),
                         segment = ConvexPolyhedron::segment({-0.5, 0, 0}, {0.5, 0, 0});
  const MinimumTranslation m =
      largestGap({box, Pose{}, segment, Pose{Quat::Identity(), Vec3(0.1, 0.2, 0.6)}});
  EXPECT_NEAR(m.gap_m, -0.4, 1e-15);
  EXPECT_LT((m.normal - Vec3::UnitZ()).norm(), 1e-15);
}

// The rounding of a cross product, some 1e-16, turns it by that over the sine: across directions that are
// parallel but for 1e-10 it is right to a few millionths, and closer to parallel there is none. Across the
// first it is to the rounding over a sine of 0.1, at worst.
TEST(CommonPerpendicular, IsRightToItsRoundingOrThereIsNone) {
  Random random(311);
  int none = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d1 = random.direction();
    const Vec3 aside = d1.cross(random.direction()).normalized();
    const double turn = random.logUniform(1e-12, 1.0);
    const Vec3 d2 = (std::cos(turn) * d1 + std::sin(turn) * aside).normalized();
    const oracle::Vec3R cross = d1.cast<oracle::Real>().cross(d2.cast<oracle::Real>());
    const auto sine = static_cast<double>(cross.norm());
    const auto across = commonPerpendicular(d1, d2);
    if (sine < 0.99e-10 || sine > 1.01e-10) {
      ASSERT_EQ(across.has_value(), sine > 1e-10) << sine;
    }
    none += !across;
    if (!across) continue;
    const Vec3 n = cross.normalized().cast<double>();
    ASSERT_LT((across->direction - n).norm(), 4e-16 / sine + 4e-16) << sine;
    ASSERT_NEAR(across->inverse_sine * sine, 1.0, 4e-16 / sine + 4e-16);
    ASSERT_LT(std::abs(across->direction.dot(d1)), 2e-15) << sine;
  }
  EXPECT_GT(none, 2000);
}

// Edges that are almost parallel: their cross product is mostly rounding, which must not show in the gap
// along it. Against the heights of all vertices along the axis itself, in long double.
TEST(MinimumTranslation, AcrossAlmostParallelEdges_IsTheGapAlongItsOwnNormal) {
  Random random(310);
  const ConvexPolyhedron a = oracle::randomHull(random, 10), b = oracle::randomHull(random, 10);
  int supporting = 0;
  for (int i = 0; i < 20000; ++i) {
    const int edge_a = random.integer(0, a.edgeCount() - 1), edge_b = random.integer(0, b.edgeCount() - 1);
    const Edge& e1 = a.edge(edge_a);
    const Edge& e2 = b.edge(edge_b);
    const Vec3 outward = a.plane(e1.left).normal + a.plane(e1.right).normal;
    const Vec3 outward_b = b.plane(e2.left).normal + b.plane(e2.right).normal;
    // B's edge along A's and outwards against outwards, then turned a little.
    Mat3 frame_a, frame_b;
    frame_a << e1.direction, outward.normalized(), e1.direction.cross(outward.normalized());
    frame_b << e2.direction, -outward_b.normalized(), -e2.direction.cross(outward_b.normalized());
    const double angle = random.logUniform(1e-9, 0.05);
    const Quat R = (oracle::turned(outward.normalized(), angle) * Quat(Mat3(frame_a * frame_b.transpose())))
                       .normalized();
    const PolyhedronPair pair(a, Pose{}, b, {R, 0.9 * outward + 0.1 * random.direction()});
    const auto across = gapAcrossEdges(pair, edge_a, edge_b, outward);
    if (!across) continue;
    ++supporting;
    const oracle::PlacedConvex pa = oracle::place({a, 0.0}, Pose{}),
                               pb = oracle::place({b, 0.0}, {R, pair.t_AB});
    const oracle::Vec3R n = across->normal.cast<oracle::Real>().normalized();
    ASSERT_NEAR(across->gap_m, static_cast<double>(oracle::gapAlong(pa, pb, n)), 4e-15)
        << i << " at " << angle;
  }
  EXPECT_GT(supporting, 15000);
}

}  // namespace
}  // namespace carom
