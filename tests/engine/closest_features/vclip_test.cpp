// V-Clip by hand-made poses: the five states, rounding radii, invariances, tracking, and each known trap by
// name. Random and adversarial pairs are in vclip_random_test.cpp.

#include "engine/closest_features/vclip.h"

#include <gtest/gtest.h>

#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/witness_certificate.h"
#include "tests/support/features.h"

namespace carom {
namespace {

using oracle::Random;
using oracle::turned;

constexpr double kQuarter = std::numbers::pi / 4;

ConvexPart part(ConvexPolyhedron core, double radius_m = 0.0) {
  return {std::move(core), radius_m};
}
ConvexPart box(const Vec3& size_m) {
  return part(boxPolyhedron(size_m));
}
ConvexPart ball(double radius_m) {
  return part(ConvexPolyhedron::point(Vec3::Zero()), radius_m);
}
ConvexPart capsule(double radius_m, double length_m) {
  return part(ConvexPolyhedron::segment({0, 0, -length_m / 2}, {0, 0, length_m / 2}), radius_m);
}
Pose at(double x, double y, double z, const Quat& rotation = Quat::Identity()) {
  return {rotation, Vec3(x, y, z)};
}

ClosestFeatures cold(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB) {
  FeaturePair tracked;
  return closestFeatures(a, X_WA, b, X_WB, tracked);
}

void expectKinds(const ClosestFeatures& c, FeatureKind a, FeatureKind b) {
  EXPECT_EQ(c.features.a.kind, a);
  EXPECT_EQ(c.features.b.kind, b);
}

// The answer as a proof about the two parts.
double errorOf(const ClosestFeatures& c, const ConvexPart& a, const Pose& X_WA, const ConvexPart& b,
               const Pose& X_WB) {
  return static_cast<double>(
      oracle::separationError(oracle::place(a, X_WA), oracle::place(b, X_WB),
                              {c.distance_m, c.p_A_W.cast<oracle::Real>(), c.p_B_W.cast<oracle::Real>(),
                               c.n_W.cast<oracle::Real>()}));
}

// ---- the five states (paper §2) ----

TEST(VClip, VertexVertex) {
  const ClosestFeatures c = cold(box({1, 1, 1}), Pose{}, box({1, 1, 1}), at(2, 3, 3));
  expectKinds(c, FeatureKind::kVertex, FeatureKind::kVertex);
  EXPECT_EQ(c.status, Separation::kSeparated);
  EXPECT_NEAR(c.distance_m, 3.0, 1e-15);
  EXPECT_LT((c.p_A_W - Vec3(0.5, 0.5, 0.5)).norm(), 1e-15);
  EXPECT_LT((c.p_B_W - Vec3(1.5, 2.5, 2.5)).norm(), 1e-15);
  EXPECT_LT((c.n_W - Vec3(1, 2, 2) / 3).norm(), 1e-15);
}

TEST(VClip, VertexEdge) {
  // B stands on a corner beside A's upright edge.
  const ClosestFeatures c = cold(box({1, 1, 2}), Pose{}, part(oracle::octahedron()),
                                 at(2, 2, 0.25, turned(Vec3::UnitZ(), kQuarter)));
  expectKinds(c, FeatureKind::kEdge, FeatureKind::kVertex);
  EXPECT_NEAR(c.distance_m, 1.5 * std::numbers::sqrt2 - 1, 1e-15);
  EXPECT_LT((c.p_A_W - Vec3(0.5, 0.5, 0.25)).norm(), 1e-15);
  EXPECT_LT((c.n_W - Vec3(1, 1, 0).normalized()).norm(), 1e-15);
}

TEST(VClip, VertexFace) {
  const ClosestFeatures c = cold(box({2, 2, 2}), Pose{}, part(oracle::octahedron()), at(0.2, 0.3, 3));
  expectKinds(c, FeatureKind::kFace, FeatureKind::kVertex);
  EXPECT_NEAR(c.distance_m, 1.0, 1e-15);
  EXPECT_LT((c.p_A_W - Vec3(0.2, 0.3, 1)).norm(), 1e-15);
  EXPECT_EQ(c.n_W, Vec3(0, 0, 1));
}

TEST(VClip, EdgeEdge) {
  const ClosestFeatures c = cold(box({1, 1, 1}), at(0, 0, 0, turned(Vec3::UnitX(), kQuarter)), box({1, 1, 1}),
                                 at(0.1, 0.2, 2, turned(Vec3::UnitY(), kQuarter)));
  expectKinds(c, FeatureKind::kEdge, FeatureKind::kEdge);
  EXPECT_NEAR(c.distance_m, 2 - std::numbers::sqrt2, 1e-15);
  EXPECT_LT((c.p_A_W - Vec3(0.1, 0, std::sqrt(0.5))).norm(), 1e-15);
  EXPECT_LT((c.n_W - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(VClip, EdgeFace_IsPenetrationWithItsExactDepth) {
  const ClosestFeatures c =
      cold(box({1, 1, 1}), Pose{}, box({1, 1, 1}), at(0.7, 0.1, 0.2, turned(Vec3::UnitX(), 0.3)));
  EXPECT_EQ(c.status, Separation::kPenetrating);
  EXPECT_NEAR(c.distance_m, -0.3, 1e-15);
  EXPECT_LT((c.n_W - Vec3::UnitX()).norm(), 1e-15);
}

// ---- rounded parts: closed forms ----

TEST(VClipRounded, BallAndBall) {
  const ClosestFeatures c = cold(ball(1), at(1, 0, 0), ball(0.5), at(1, 3, 4));
  EXPECT_NEAR(c.distance_m, 3.5, 1e-15);
  EXPECT_LT((c.p_A_W - Vec3(1, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_LT((c.p_B_W - Vec3(1, 2.7, 3.6)).norm(), 1e-15);
  const ClosestFeatures in = cold(ball(1), Pose{}, ball(0.5), at(0, 0.3, 0.4));
  EXPECT_EQ(in.status, Separation::kPenetrating);
  EXPECT_NEAR(in.distance_m, -1.0, 1e-15);
  EXPECT_LT((in.n_W - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
}

TEST(VClipRounded, BallOverAFaceAnEdgeAndACorner) {
  const ConvexPart cube = box({2, 2, 2}), b = ball(0.25);
  EXPECT_NEAR(cold(cube, Pose{}, b, at(0.3, 0.2, 2)).distance_m, 0.75, 1e-15);
  EXPECT_NEAR(cold(cube, Pose{}, b, at(0.3, 4, 5)).distance_m, 4.75, 1e-15);
  EXPECT_NEAR(cold(cube, Pose{}, b, at(2, 3, 3)).distance_m, 2.75, 1e-15);
  EXPECT_NEAR(cold(b, at(2, 3, 3), cube, Pose{}).distance_m, 2.75, 1e-15);
}

TEST(VClipRounded, BallWithItsCentreInABox_LeavesByTheNearestFace) {
  const ClosestFeatures c = cold(box({2, 2, 2}), Pose{}, ball(0.25), at(0.3, 0.2, 0.9));
  EXPECT_EQ(c.status, Separation::kPenetrating);
  EXPECT_NEAR(c.distance_m, -0.35, 1e-15);
  EXPECT_LT((c.n_W - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(VClipRounded, CapsulesCrossedParallelAndEndToEnd) {
  const ConvexPart c = capsule(0.25, 2);
  EXPECT_NEAR(cold(c, Pose{}, c, at(1, 0.3, 0.2, turned(Vec3::UnitX(), 1.0))).distance_m, 0.5, 1e-15);
  for (double shift : {0.0, 0.7, 2.0})
    EXPECT_NEAR(cold(c, Pose{}, c, at(0, 1, shift)).distance_m, 0.5, 1e-15);
  EXPECT_NEAR(cold(c, Pose{}, c, at(0, 3, 6)).distance_m, 4.5, 1e-15);
  EXPECT_NEAR(cold(c, Pose{}, c, at(0, 0, 3)).distance_m, 0.5, 1e-15);
}

TEST(VClipRounded, CapsuleOnAFace_StandsOffByItsRadius) {
  const Quat lying = turned(Vec3::UnitY(), std::numbers::pi / 2);
  EXPECT_NEAR(cold(box({4, 4, 1}), Pose{}, capsule(0.25, 2), at(0.1, 0.2, 1, lying)).distance_m, 0.25, 1e-15);
}

TEST(VClipRounded, OneCentreOrOneAxis_HasTheFullDepthAndAUnitNormal) {
  const ClosestFeatures balls = cold(ball(1), at(3, 2, 1), ball(0.5), at(3, 2, 1));
  EXPECT_NEAR(balls.distance_m, -1.5, 1e-15);
  EXPECT_NEAR(balls.n_W.norm(), 1.0, 1e-15);
  for (double shift : {0.0, 0.5, 1.9}) {
    const ClosestFeatures axis = cold(capsule(0.5, 2), Pose{}, capsule(0.25, 2), at(0, 0, shift));
    EXPECT_NEAR(axis.distance_m, -0.75, 1e-15) << shift;
    EXPECT_NEAR(axis.n_W.z(), 0.0, 1e-15) << "across the axis";
  }
  const ClosestFeatures crossed =
      cold(capsule(0.5, 2), Pose{}, capsule(0.25, 2), at(0, 0.1, 0, turned(Vec3::UnitX(), 1.2)));
  EXPECT_NEAR(crossed.distance_m, -0.75, 1e-15);
  EXPECT_NEAR(std::abs(crossed.n_W.x()), 1.0, 1e-15);
}

// ---- invariances ----

TEST(VClip, SwappingTheBodies_SwapsTheAnswer) {
  oracle::AdversarialPairs pairs(71);
  for (int i = 0; i < 2000; ++i) {
    const oracle::PosedPair p = pairs.nextSmall();
    const ClosestFeatures ab = cold(*p.a, p.X_WA, *p.b, p.X_WB), ba = cold(*p.b, p.X_WB, *p.a, p.X_WA);
    ASSERT_EQ(ab.status, ba.status) << i;
    ASSERT_NEAR(ab.distance_m, ba.distance_m, 1e-14 * p.scale()) << i;
    if (ab.distance_m < 1e-6) continue;
    ASSERT_LT((ab.n_W + ba.n_W).norm(), 1e-9) << i;
    ASSERT_LT((ab.p_A_W - ba.p_B_W).norm(), 1e-9) << i;
    ASSERT_EQ(ab.features, (FeaturePair{ba.features.b, ba.features.a})) << i;
  }
}

TEST(VClip, MovingBothRigidly_MovesTheAnswer) {
  oracle::AdversarialPairs pairs(72);
  for (int i = 0; i < 2000; ++i) {
    const oracle::PosedPair p = pairs.nextSmall();
    const Pose X = pairs.random().pose(3.0);
    const ClosestFeatures here = cold(*p.a, p.X_WA, *p.b, p.X_WB),
                          there = cold(*p.a, X * p.X_WA, *p.b, X * p.X_WB);
    ASSERT_EQ(here.status, there.status) << i;
    ASSERT_NEAR(here.distance_m, there.distance_m, 1e-14 * (p.scale() + 3)) << i;
    if (here.distance_m < 1e-6) continue;
    ASSERT_LT((X.rotation * here.n_W - there.n_W).norm(), 1e-9) << i;
    ASSERT_LT((X * here.p_A_W - there.p_A_W).norm(), 1e-9) << i;
  }
}

TEST(VClip, ScalingBothByAPowerOfTwo_ScalesTheDistanceToTheBit) {
  Random random(73);
  const ConvexPolyhedron p = oracle::dodecahedron();
  std::vector<Vec3> doubled;
  for (const Vec3& v : p.vertices()) doubled.push_back(8.0 * v);
  std::vector<std::vector<int>> loops;
  for (int f = 0; f < p.faceCount(); ++f)
    loops.emplace_back(p.faceVertices(f).begin(), p.faceVertices(f).end());
  const ConvexPart small = part(p), large = part(ConvexPolyhedron::fromFaces(doubled, loops));
  for (int i = 0; i < 500; ++i) {
    Pose X_WA = random.pose(1), X_WB = random.pose(6);
    const ClosestFeatures s = cold(small, X_WA, small, X_WB);
    X_WA.position *= 8.0;
    X_WB.position *= 8.0;
    const ClosestFeatures l = cold(large, X_WA, large, X_WB);
    ASSERT_EQ(8.0 * s.distance_m, l.distance_m) << i;
    ASSERT_EQ(s.features, l.features) << i;
  }
}

// ---- where the walk starts does not matter ----

void expectEverySeedAgrees(const ConvexPart& a, const ConvexPart& b, const Pose& X_WB, int stride) {
  const ClosestFeatures want = cold(a, Pose{}, b, X_WB);
  const std::vector<Feature> seeds_a = allFeatures(a.core), seeds_b = allFeatures(b.core);
  int i = 0;
  for (const Feature& fa : seeds_a)
    for (const Feature& fb : seeds_b) {
      if (i++ % stride != 0) continue;
      FeaturePair tracked{fa, fb};
      const ClosestFeatures got = closestFeatures(a, Pose{}, b, X_WB, tracked);
      ASSERT_EQ(got.status, want.status) << "seed " << i;
      ASSERT_NEAR(got.distance_m, want.distance_m, 1e-14) << "seed " << i;
      ASSERT_FALSE(got.reached_limit) << "seed " << i;
      EXPECT_EQ(tracked, got.features);
    }
}

TEST(VClip, EverySeedGivesTheSameDistance) {
  const ConvexPart solids[] = {box({1, 1, 1}), part(oracle::triangulatedBox({1, 1, 1})),
                               part(oracle::dodecahedron()), part(oracle::prism(60, 1.0, 1.0))};
  const Quat q = turned({1, 2, 3}, 0.7);
  for (const ConvexPart& a : solids)
    for (const ConvexPart& b : solids) {
      const int stride =
          std::max(1, static_cast<int>(allFeatures(a.core).size() * allFeatures(b.core).size()) / 4000);
      expectEverySeedAgrees(a, b, at(3.1, 1.2, 0.4, q), stride);
      expectEverySeedAgrees(a, b, at(0, 0, 4), stride);
      expectEverySeedAgrees(a, b, at(2.75, 0, 0, turned(Vec3::UnitZ(), kQuarter)), stride);
      expectEverySeedAgrees(a, b, at(0.3, 0.2, 0.1, q), 10 * stride);
    }
}

TEST(VClip, TrackedFromPoseToPose_EqualsAColdStart) {
  Random random(74);
  const ConvexPart solids[] = {box({1, 2, 0.5}),
                               part(oracle::triangulatedBox({1, 1, 1})),
                               part(oracle::dodecahedron()),
                               part(oracle::prism(60, 1.0, 1.0)),
                               part(oracle::randomHull(random, 62)),
                               capsule(0.3, 1)};
  for (const ConvexPart& a : solids)
    for (const ConvexPart& b : solids)
      for (const double height : {3.5, 1.4}) {  // apart, and in and out of contact
        FeaturePair tracked;
        for (int degree = 0; degree < 360; ++degree) {
          const double angle = degree * std::numbers::pi / 180;
          const Pose X_WB =
              at(0.3 * std::cos(angle), 0.2, height + 0.1 * std::sin(angle), turned({1, 0.3, 0.2}, angle));
          const ClosestFeatures got = closestFeatures(a, Pose{}, b, X_WB, tracked);
          const ClosestFeatures want = cold(a, Pose{}, b, X_WB);
          ASSERT_EQ(got.status, want.status) << degree;
          ASSERT_NEAR(got.distance_m, want.distance_m, 1e-13) << degree;
        }
      }
}

// A cube that leaves another by either of two faces goes on leaving by the one that was nearer before.
TEST(VClip, OfTwoFacesEquallyNear_TheTrackedOneStays) {
  const ConvexPart cube = box({1, 1, 1});
  for (const Quat& turn : {Quat::Identity(), turned(Vec3(0.3, -0.7, 0.6).normalized(), 1.1)})
    for (int axis = 0; axis < 3; ++axis)
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        Vec3 way = 0.7 * Vec3::Unit(axis) + 0.6 * Vec3::Unit(other);
        PairMemory memory;
        EXPECT_NEAR(closestFeatures(cube, {turn, Vec3::Zero()}, cube, {turn, turn * way}, memory).distance_m,
                    -0.3, 1e-14);
        way[other] = 0.7;
        const ClosestFeatures tie =
            closestFeatures(cube, {turn, Vec3::Zero()}, cube, {turn, turn * way}, memory);
        EXPECT_NEAR(tie.distance_m, -0.3, 1e-14);
        EXPECT_NEAR(tie.n_W.dot(turn * Vec3::Unit(axis)), 1.0, 1e-12) << axis << " before " << other;
      }
}

TEST(VClip, ACoherentQueryVisitsFewStates) {
  Random random(75);
  const ConvexPart a = part(oracle::randomHull(random, 252)), b = part(oracle::randomHull(random, 252));
  FeaturePair tracked;
  double states = 0;
  for (int degree = 0; degree < 720; ++degree) {
    const Quat q = turned({1, 0.3, 0.2}, degree * std::numbers::pi / 180);
    states += closestFeatures(a, Pose{}, b, at(0.1, 0.2, 2.5, q), tracked).states;
  }
  EXPECT_LT(states / 720, 3.0) << "one degree a query, 252 vertices";
}

// ---- known traps ----

// Reproduction known to break the classic implementation: the distance is 0.5, not 1.5.
TEST(VClipTrap, TwoTriangulatedCubesHalfTurned_AreHalfAMetreApart) {
  const ConvexPart cube = part(oracle::triangulatedBox({1, 1, 1}));
  const Pose X_WB = at(1.5, -0.375, 0.375, turned(Vec3::UnitZ(), std::numbers::pi));
  const ClosestFeatures c = cold(cube, Pose{}, cube, X_WB);
  EXPECT_EQ(c.status, Separation::kSeparated);
  EXPECT_NEAR(c.distance_m, 0.5, 1e-15);
  EXPECT_LT(errorOf(c, cube, Pose{}, cube, X_WB), 1e-15);
}

// A flat edge's V-planes are passed by the inward normal too: deep inside, the walk must not end there as
// separated.
TEST(VClipTrap, ACornerBelowAFlatEdge_IsInside) {
  const ConvexPart outer = part(oracle::triangulatedBox({2, 2, 2})), inner = box({0.5, 0.5, 0.5});
  for (double x : {-0.5, -0.25, 0.0, 0.25, 0.5})
    for (double y : {-0.5, -0.25, 0.0, 0.25, 0.5})
      for (const Feature& fa : allFeatures(outer.core))
        for (int v = 0; v < 8; ++v) {
          FeaturePair tracked{fa, vertexFeature(v)};
          const ClosestFeatures c = closestFeatures(outer, Pose{}, inner, at(x, y, 0.1), tracked);
          ASSERT_EQ(c.status, Separation::kPenetrating) << x << " " << y;
          ASSERT_NEAR(c.distance_m, -(1.25 - std::max({std::abs(x), std::abs(y), 0.1})), 1e-15)
              << x << " " << y;
        }
}

// A tilt of 1e-9 over a metre: a step on one body gains half its square, which is below rounding; the near
// corner is 1e-9 closer all the same. Any seed must find it.
TEST(VClipTrap, AlmostParallelFaces_AreMeasuredAtTheirNearCorner) {
  const ConvexPart a = box({1, 1, 1});
  for (const ConvexPart& b : {box({1, 1, 1}), part(oracle::triangulatedBox({1, 1, 1}))})
    for (const double tilt : {1e-13, 1e-10, 1e-9, 1e-8, 1e-7})
      for (const double spin : {0.0, 0.4}) {
        const Quat q = turned({1, 0.4, 0}, tilt) * turned(Vec3::UnitZ(), spin);
        const Pose X_WB = at(0, 0, 1.3, q);
        const auto want =
            static_cast<double>(oracle::surfaceDistance(oracle::place(a, Pose{}), oracle::place(b, X_WB)));
        for (const Feature& fa : allFeatures(a.core))
          for (const Feature& fb : allFeatures(b.core)) {
            FeaturePair tracked{fa, fb};
            ASSERT_NEAR(closestFeatures(a, Pose{}, b, X_WB, tracked).distance_m, want, 3e-12)
                << tilt << " " << spin;
          }
      }
}

TEST(VClipTrap, CoincidentBodies_HaveTheirWidthAsDepth) {
  Random random(76);
  const Pose X = random.pose(2);
  EXPECT_NEAR(cold(box({1, 0.4, 2}), X, box({1, 0.4, 2}), X).distance_m, -0.4, 1e-15);
  const ConvexPart d = part(oracle::dodecahedron());
  EXPECT_NEAR(cold(d, X, d, X).distance_m, -d.core.width(), 1e-14);
}

TEST(VClipTrap, TouchingFaces_TouchWithWitnessesInBoth) {
  for (const ConvexPart& b : {box({1, 1, 1}), part(oracle::triangulatedBox({1, 1, 1}))})
    for (double x : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const Pose X_WB = at(x, 0.25, 1);
      const ClosestFeatures c = cold(box({1, 1, 1}), Pose{}, b, X_WB);
      EXPECT_EQ(c.status, Separation::kTouching) << x;
      EXPECT_LT(errorOf(c, box({1, 1, 1}), Pose{}, b, X_WB), 1e-15) << x;
    }
}

TEST(VClipTrap, AVertexExactlyOnAFace_Touches) {
  const ClosestFeatures c = cold(box({2, 2, 2}), Pose{}, part(oracle::octahedron()), at(0.25, 0.125, 2));
  EXPECT_EQ(c.status, Separation::kTouching);
  EXPECT_EQ(c.n_W, Vec3(0, 0, 1));
  EXPECT_LT((c.p_A_W - Vec3(0.25, 0.125, 1)).norm(), 1e-15);
}

TEST(VClipTrap, EdgesThatCrossInOnePoint_Touch) {
  const Pose X_WA = at(0, 0, 0, turned(Vec3::UnitX(), kQuarter)),
             X_WB = at(0.1, 0.2, std::numbers::sqrt2, turned(Vec3::UnitY(), kQuarter));
  const ClosestFeatures c = cold(box({1, 1, 1}), X_WA, box({1, 1, 1}), X_WB);
  EXPECT_NEAR(c.distance_m, 0.0, 1e-15);
  EXPECT_LT((c.n_W - Vec3::UnitZ()).norm(), 1e-15);
}

// The edges cross inside both bodies and pierce no face near them.
TEST(VClipTrap, EdgesThatCrossInsideBoth_Penetrate) {
  for (const double overlap : {1e-9, 1e-6, 1e-3, 0.1, 0.4}) {
    const Pose X_WB = at(0.1, 0.1, std::numbers::sqrt2 - overlap, turned(Vec3::UnitY(), kQuarter));
    const ClosestFeatures c =
        cold(box({1, 1, 1}), at(0, 0, 0, turned(Vec3::UnitX(), kQuarter)), box({1, 1, 1}), X_WB);
    EXPECT_EQ(c.status, Separation::kPenetrating) << overlap;
    EXPECT_NEAR(c.distance_m, -overlap, 1e-15) << overlap;
  }
}

TEST(VClipTrap, ParallelEdges_HaveOneDistanceWhereverTheyAreSeeded) {
  const ConvexPart a = box({1, 3, 1});
  const Quat roof = turned(Vec3::UnitY(), kQuarter);
  for (double shift : {-2.9, -1.0, 0.0, 1e-9, 2.9})
    for (const Feature& fa : allFeatures(a.core))
      for (const Feature& fb : allFeatures(a.core)) {
        FeaturePair tracked{fa, fb};
        const ClosestFeatures c = closestFeatures(a, at(0, 0, 0, roof), a, at(0, shift, 2, roof), tracked);
        ASSERT_NEAR(c.distance_m, 2 - std::numbers::sqrt2, 1e-15) << shift;
      }
}

TEST(VClipTrap, AlmostParallelEdges_AreMeasuredToRounding) {
  const ConvexPart a = box({1, 3, 1});
  const Quat roof = turned(Vec3::UnitY(), kQuarter);
  for (const double tilt : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    const Pose X_WA = at(0, 0, 0, roof), X_WB = at(0, 0.3, 2, turned({0.6, 0, 1}, tilt) * roof);
    const auto want =
        static_cast<double>(oracle::surfaceDistance(oracle::place(a, X_WA), oracle::place(a, X_WB)));
    EXPECT_NEAR(cold(a, X_WA, a, X_WB).distance_m, want, 1e-14) << tilt;
  }
}

TEST(VClipTrap, ATinySolidOverAHugeOne_IsMeasuredToItsOwnSize) {
  const ConvexPart tiny = box({1e-3, 1e-3, 1e-3}), huge = box({200, 200, 200});
  for (double x : {0.0, 37.0, 99.9995}) {
    const ClosestFeatures c = cold(huge, Pose{}, tiny, at(x, -12.5, 100 + 0.5e-3 + 1e-6));
    EXPECT_NEAR(c.distance_m, 1e-6, 2e-14) << x;
  }
}

TEST(VClipTrap, FarFromTheOrigin_OnlyThePosesRoundingIsLost) {
  Random random(77);
  const ConvexPart a = part(oracle::randomHull(random, 20)), b = part(oracle::dodecahedron());
  const Vec3 away(0x1p13, -0x1p14, 0x1p12);
  for (int i = 0; i < 200; ++i) {
    Pose X_WA = random.pose(1), X_WB = random.pose(5);
    for (Pose* X : {&X_WA, &X_WB})
      X->position = (X->position * 0x1p20).array().round().matrix() * 0x1p-20;  // no rounding when moved
    const double here = cold(a, X_WA, b, X_WB).distance_m;
    X_WA.position += away;
    X_WB.position += away;
    ASSERT_EQ(cold(a, X_WA, b, X_WB).distance_m, here) << i;
  }
}

TEST(VClipTrap, ADriftedRotation_CostsNoMoreThanItsDrift) {
  Random random(78);
  const ConvexPart a = part(oracle::dodecahedron()), b = box({1, 2, 1});
  for (int i = 0; i < 200; ++i) {
    Pose X_WA = random.pose(1), X_WB = random.pose(5);
    const double exact = cold(a, X_WA, b, X_WB).distance_m;
    X_WA.rotation.coeffs() *= 1.0 + 1e-12;
    X_WB.rotation.coeffs() *= 1.0 - 1e-12;
    ASSERT_NEAR(cold(a, X_WA, b, X_WB).distance_m, exact, 1e-10) << i;
  }
}

TEST(VClipTrap, DepthIsContinuousWhileABodySinksIn) {
  const ConvexPart a = part(oracle::dodecahedron()), b = box({1, 1, 1});
  FeaturePair tracked;
  double before = 10;
  for (int i = 0; i <= 4000; ++i) {
    const double z = 4 - 1e-3 * i;
    const double d =
        closestFeatures(a, Pose{}, b, at(0.1, 0.2, z, turned({1, 2, 3}, 0.5)), tracked).distance_m;
    if (i > 0) {
      ASSERT_LE(std::abs(d - before), 1e-3 + 1e-14) << "moved a millimetre at z = " << z;
    }
    before = d;
  }
}

}  // namespace
}  // namespace carom
