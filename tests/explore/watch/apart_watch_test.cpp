// Overlaps of a hair are seen, gaps of a hair are not called overlaps, whatever was looked at before.

#include "tests/explore/watch/apart_watch.h"

#include <gtest/gtest.h>

#include "tests/oracle/overlap_oracle.h"
#include "tests/oracle/test_shapes.h"

namespace carom::explore {
namespace {

/// Two bodies of these solids; the poses are given to `deepest` one by one.
World twoBodies(const Solid& a, const Solid& b) {
  World world{WorldSettings{}};
  for (const Solid* solid : {&a, &b}) {
    BodyDescription d;
    d.solid = world.addSolid(*solid);
    world.addBody(d);
  }
  return world;
}

std::vector<BodyState> statesOf(const Pose& X_a, const Pose& X_b) {
  std::vector<BodyState> states(2);
  states[0].X_WB = X_a;
  states[1].X_WB = X_b;
  return states;
}

TEST(ApartWatch, ANanometreIsSeenOnEitherSideInAnyPose) {
  const World world = twoBodies(Solid::box({1, 1, 1}), Solid::box({1, 2, 1}));
  ApartWatch watch(world);
  oracle::Random random(31);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random.pose(50.0);
    const Vec3 up(0.1, 0.2, 1.0);
    EXPECT_FALSE(watch.deepest(statesOf(X, X * Pose{Quat::Identity(), up + Vec3(0, 0, 1e-9)}))) << i;
    const auto meeting = watch.deepest(statesOf(X, X * Pose{Quat::Identity(), up - Vec3(0, 0, 1e-9)}));
    ASSERT_TRUE(meeting) << i;
    EXPECT_NEAR(meeting->depth_m, 1e-9, 1e-12);
  }
}

TEST(ApartWatch, RoundPartsMeetWhereTheirSurfacesDo) {
  const World world = twoBodies(Solid::capsule(0.2, 1.0), Solid::ball(0.3));
  ApartWatch watch(world);
  oracle::Random random(32);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random.pose(5.0);
    const Vec3 aside(0.5 * std::cos(0.1 * i), 0.5 * std::sin(0.1 * i), 0.3);
    EXPECT_FALSE(watch.deepest(
        statesOf(X, X * Pose{Quat::Identity(), aside.cwiseProduct(Vec3(1 + 1e-9, 1 + 1e-9, 1))})));
    EXPECT_TRUE(watch.deepest(
        statesOf(X, X * Pose{Quat::Identity(), aside.cwiseProduct(Vec3(1 - 1e-9, 1 - 1e-9, 1))})));
  }
}

TEST(ApartWatch, AgreesWithBruteForceOverAWanderingPair) {
  oracle::Random random(33);
  const Solid a = Solid::polyhedron(oracle::randomHull(random, 10)),
              b = Solid::polyhedron(oracle::randomHull(random, 12));
  const World world = twoBodies(a, b);
  ApartWatch watch(world);
  int meetings = 0;
  for (int i = 0; i < 500; ++i) {
    const Pose X_b = random.pose(2.2);
    const std::vector<BodyState> states = statesOf(Pose{}, X_b);
    const oracle::PlacedSolid placed[] = {{&a, Pose{}}, {&b, X_b}};
    const double gap = oracle::smallestGap(placed).gap_m;
    const auto meeting = watch.deepest(states);
    ASSERT_EQ(meeting.has_value(), gap <= 0.0) << i;
    if (meeting) {
      EXPECT_NEAR(meeting->depth_m, -gap, 1e-12);
    }
    meetings += meeting.has_value();
  }
  EXPECT_GT(meetings, 100);
  EXPECT_LT(meetings, 400);
}

}  // namespace
}  // namespace carom::explore
