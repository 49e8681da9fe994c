// The oracles themselves, against closed forms worked by hand: an oracle that cannot fail proves nothing.

#include <gtest/gtest.h>

#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"
#include "tests/oracle/witness_certificate.h"

namespace carom::oracle {
namespace {

ConvexPart cube() {
  return {boxPolyhedron(Vec3::Ones()), 0.0};
}
Pose at(double x, double y, double z, const Quat& rotation = Quat::Identity()) {
  return {rotation, Vec3(x, y, z)};
}

TEST(BruteForce, CubesApart_AreTheFaceEdgeAndVertexDistance) {
  const PlacedConvex a = place(cube(), Pose{});
  EXPECT_NEAR(double(signedGap(a, place(cube(), at(1.5, 0.2, 0.1)))), 0.5, 1e-15);
  EXPECT_NEAR(double(signedGap(a, place(cube(), at(1.3, 1.4, 0.1)))), 0.5, 1e-15);
  EXPECT_NEAR(double(signedGap(a, place(cube(), at(2.0, 3.0, 3.0)))), 3.0, 1e-15);
}

TEST(BruteForce, CrossedEdges_AreTheirCommonPerpendicular) {
  // Turned by 45 degrees about y, B's lower edge runs along y at height z - sqrt(1/2); A's upper one along x.
  const PlacedConvex a = place(cube(), at(0, 0, 0, turned(Vec3::UnitX(), std::numbers::pi / 4)));
  const PlacedConvex b = place(cube(), at(0.1, 0.2, 2.0, turned(Vec3::UnitY(), std::numbers::pi / 4)));
  EXPECT_NEAR(double(signedGap(a, b)), 2.0 - std::numbers::sqrt2, 1e-15);
}

TEST(BruteForce, OverlappingCubes_AreMinusTheLeastDepth) {
  const PlacedConvex a = place(cube(), Pose{});
  EXPECT_NEAR(double(signedGap(a, place(cube(), at(0.7, 0.2, 0.1)))), -0.3, 1e-15);
  EXPECT_NEAR(double(signedGap(a, place(cube(), Pose{}))), -1.0, 1e-15);
}

TEST(BruteForce, CrossedEdgesInside_NeedTheEdgeAxes) {
  const Quat qa = turned(Vec3::UnitX(), std::numbers::pi / 4),
             qb = turned(Vec3::UnitY(), std::numbers::pi / 4);
  const AxisGap gap = largestAxisGap(place(cube(), at(0, 0, 0, qa)), place(cube(), at(0, 0, 1.3, qb)));
  EXPECT_NEAR(double(gap.gap_m), 1.3 - std::numbers::sqrt2, 1e-15);
  EXPECT_NEAR(double(gap.axis.z()), 1.0, 1e-15);
}

TEST(BruteForce, BallsAndCapsules_FollowFromTheirCores) {
  const ConvexPart ball{ConvexPolyhedron::point(Vec3::Zero()), 0.25};
  const ConvexPart capsule{ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.5};
  EXPECT_NEAR(double(signedGap(place(ball, Pose{}), place(ball, at(3, 4, 0)))), 4.5, 1e-15);
  EXPECT_NEAR(double(signedGap(place(ball, Pose{}), place(capsule, at(0, 3, -5)))), 5.0 - 0.75, 1e-15);
  EXPECT_NEAR(
      double(signedGap(place(capsule, Pose{}), place(capsule, at(0.3, 2, 0, turned(Vec3::UnitX(), 1.0))))),
      std::hypot(0.3, 2.0 - std::sin(1.0)) - 1.0, 1e-15);  // the tilted one's end against the other's side
  EXPECT_NEAR(
      double(signedGap(place(capsule, Pose{}), place(capsule, at(2, 0, 0, turned(Vec3::UnitX(), 1.0))))), 1.0,
      1e-15);
  EXPECT_NEAR(double(signedGap(place(cube(), Pose{}), place(ball, at(0, 0, 0.6)))), 0.1 - 0.25, 1e-15);
  EXPECT_NEAR(double(signedGap(place(cube(), Pose{}), place(ball, at(0, 0.1, 0.4)))), -0.1 - 0.25, 1e-15);
}

TEST(WitnessCertificate, AcceptsTheTruthAndRefutesWhatIsWrong) {
  const PlacedConvex a = place(cube(), Pose{});
  const PlacedConvex b = place(cube(), at(1.5, 0.2, 0.1));
  const ClaimedAnswer truth{0.5L, Vec3R(0.5L, 0.3L, 0.2L), Vec3R(1.0L, 0.3L, 0.2L), Vec3R(1, 0, 0)};
  EXPECT_LT(separationError(a, b, truth), 1e-15L);
  ClaimedAnswer far_witness = truth, wrong_way = truth, wrong_distance = truth;
  far_witness.p_A.y() = far_witness.p_B.y() = 0.7L;
  wrong_way.n = -truth.n;
  wrong_distance.distance_m = 0.51L;
  EXPECT_GT(separationError(a, b, far_witness), 0.1L);
  EXPECT_GT(separationError(a, b, wrong_way), 0.1L);
  EXPECT_GT(separationError(a, b, wrong_distance), 0.005L);
}

TEST(WitnessCertificate, CommonPointsAgreeWithTheSeparatingAxes) {
  Random random(20240601);
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexPart a{randomHull(random, random.integer(4, 12)), 0.0};
    const ConvexPart b{randomHull(random, random.integer(4, 12), Vec3(1.0, 0.4, 0.1)), 0.0};
    const PlacedConvex pa = place(a, random.pose(1.0)), pb = place(b, random.pose(1.0));
    const bool common = intersect(pa, pb);
    overlapping += common;
    EXPECT_EQ(common, largestAxisGap(pa, pb).gap_m < 0) << "pair " << i;
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 250);
}

TEST(OverlapOracle, NamesTheClosestPairOfAll) {
  const Solid box = Solid::box(Vec3::Ones()), ball = Solid::ball(0.5);
  std::vector<PlacedSolid> bodies{
      {&box, at(0, 0, 0), true}, {&box, at(0, 0, 1.01), false}, {&ball, at(0, 3, 0), false}};
  SmallestGap smallest = smallestGap(bodies);
  EXPECT_NEAR(smallest.gap_m, 0.01, 1e-15);
  EXPECT_EQ(smallest.body_a, 0);
  EXPECT_EQ(smallest.body_b, 1);
  bodies[2].X_WB.position = Vec3(0, 0.95, 0);
  smallest = smallestGap(bodies);
  EXPECT_NEAR(smallest.gap_m, -0.05, 1e-15);
  EXPECT_EQ(smallest.body_b, 2);
}

// What is passed over changes nothing: random bodies, loose and overlapping, against every pair by itself.
TEST(OverlapOracle, IsTheLeastOfAllPairsByThemselves) {
  Random random(5);
  int overlapping = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Solid> solids{Solid::box({1, 0.4, 0.7}), Solid::ball(0.4), Solid::capsule(0.2, 0.9),
                                    Solid::polyhedron(randomHull(random, 9))};
    std::vector<PlacedSolid> bodies;
    for (int i = 0; i < 9; ++i)
      bodies.push_back(
          {&solids[static_cast<std::size_t>(i % 4)], random.pose(trial % 2 ? 12.0 : 2.5), i % 5 == 0});
    if (trial % 8 == 0) bodies[2].X_WB.position = bodies[1].X_WB.position;  // no line between their centres
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t j = i + 1; j < bodies.size(); ++j)
        if (!bodies[i].is_static || !bodies[j].is_static)
          least = std::min(
              least, static_cast<double>(signedGap(place(bodies[i].solid->parts()[0], bodies[i].X_WB),
                                                   place(bodies[j].solid->parts()[0], bodies[j].X_WB))));
    EXPECT_NEAR(smallestGap(bodies).gap_m, least, 1e-15) << "trial " << trial;
    overlapping += least < 0.0;
  }
  EXPECT_GT(overlapping, 10);
  EXPECT_LT(overlapping, 35);
}

// Nor does what is passed over for the axes of earlier frames: bodies that tumble through each other.
TEST(OverlapOracle, AskedFrameAfterFrame_IsTheSame) {
  Random random(6);
  const std::vector<Solid> solids{Solid::box({1, 0.4, 0.7}), Solid::ball(0.4), Solid::capsule(0.2, 0.9),
                                  Solid::polyhedron(randomHull(random, 9))};
  std::vector<PlacedSolid> bodies;
  std::vector<Vec3> axes, steps;
  for (int i = 0; i < 12; ++i) {
    bodies.push_back({&solids[static_cast<std::size_t>(i % 4)], random.pose(5.0), i % 5 == 0});
    axes.push_back(random.direction());
    steps.push_back(0.02 * random.direction());
  }
  RememberedAxes remembered;
  int apart = 0;
  constexpr int kFrames = 300;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Pose& X_WB = bodies[i].X_WB;
      X_WB.rotation = (turned(axes[i], 0.03) * X_WB.rotation).normalized();
      X_WB.position += (frame < kFrames / 2 ? 1.0 : -1.0) * steps[i];
    }
    const SmallestGap fresh = smallestGap(bodies), kept = smallestGap(bodies, &remembered);
    EXPECT_EQ(kept.gap_m, fresh.gap_m) << frame;
    EXPECT_EQ(kept.body_a, fresh.body_a) << frame;
    EXPECT_EQ(kept.body_b, fresh.body_b) << frame;
    apart += fresh.gap_m > 0.0;
  }
  EXPECT_GT(apart, kFrames / 10);
  EXPECT_LT(apart, kFrames * 9 / 10);
}

}  // namespace
}  // namespace carom::oracle
