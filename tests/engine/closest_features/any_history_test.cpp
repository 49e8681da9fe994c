// One memory for whatever is asked: each answer is that of a query without memory, whether the pair has moved
// a little or far, is another one, or the polytope that is remembered has collapsed. Seeds 7700 to 7703; the
// same at length is tests/bench/queries/any_history.cpp.

#include <gtest/gtest.h>

#include <cmath>

#include "engine/closest_features/vclip.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Family;
using oracle::PosedPair;

constexpr int kShare = inThisBuild(1, 20);

// As a cold query: its class, its distance to 1e-12 of the size, numbers that are finite.
void expectColdAnswer(const PosedPair& pair, PairMemory& memory) {
  PairMemory none;
  const ClosestFeatures want = closestFeatures(*pair.a, pair.X_WA, *pair.b, pair.X_WB, none);
  const ClosestFeatures got = closestFeatures(*pair.a, pair.X_WA, *pair.b, pair.X_WB, memory);
  ASSERT_EQ(got.status, want.status);
  ASSERT_NEAR(got.distance_m, want.distance_m, 1e-12 * pair.scale());
  ASSERT_TRUE(got.p_A_W.allFinite() && got.p_B_W.allFinite() && std::isfinite(got.distance_m));
  ASSERT_NEAR(got.n_W.norm(), 1.0, 1e-12);
}

Pose inPlace(double w, double x, double y, double z, const Vec3& position_m) {
  return {Quat(w, x, y, z), position_m};
}

// Half a turn about x takes every triangle of the polytope into a plane of its own edges: slivers all.
TEST(AnyHistory, OfCubesAfterHalfATurn_IsNotTheirFormerDepth) {
  const ConvexPart cube{boxPolyhedron({1, 1, 1}), 0.0};
  PairMemory memory;
  const ClosestFeatures before =
      closestFeatures(cube, Pose{}, cube, inPlace(0, 1, 0, 0, {0.375, 0.75, -0.375}), memory);
  EXPECT_NEAR(before.distance_m, -0.25, 1e-15);
  const ClosestFeatures after =
      closestFeatures(cube, Pose{}, cube, inPlace(1, 0, 0, 0, {-0.375, -0.75, 1.125}), memory);
  EXPECT_NEAR(after.distance_m, 0.125, 1e-15);
  EXPECT_EQ(after.status, Separation::kSeparated);
  EXPECT_EQ(memory.penetration.triangleCount(), 0);
}

TEST(AnyHistory, OfAPolytopeWithoutItsFacet_IsForgottenWhereItProvesNothing) {
  const ConvexPolyhedron cube = boxPolyhedron({1, 1, 1});
  const PolyhedronPair deep(cube, Pose{}, cube, inPlace(0, 1, 0, 0, {0.375, 0.75, -0.375}));
  const PolyhedronPair apart(cube, Pose{}, cube, inPlace(1, 0, 0, 0, {-0.375, -0.75, 1.125}));
  InnerPolytope polytope;
  EXPECT_NEAR(polytope.minimumTranslation(deep, 1e-14).gap_m, -0.25, 1e-15);
  EXPECT_FALSE(polytope.follow(apart, 1e-14));
  EXPECT_EQ(polytope.triangleCount(), 0);
  EXPECT_NEAR(polytope.minimumTranslation(apart, 1e-14).gap_m, 0.125, 1e-15);
}

TEST(AnyHistory, OfBoxesOnALattice_IsNoMatter) {
  oracle::Random random(7700);
  const Vec3 sizes[] = {{1, 1, 1}, {1, 2, 1}, {0.5, 1, 0.25}, {2, 2, 0.5}};
  std::vector<ConvexPart> boxes;
  for (const Vec3& size : sizes) boxes.push_back({boxPolyhedron(size), 0.0});
  const Quat turns[] = {Quat(1, 0, 0, 0), Quat(0, 1, 0, 0), Quat(0, 0, 1, 0), Quat(0, 0, 0, 1)};
  for (int run = 0; run < 40; ++run) {
    PosedPair pair{&boxes[static_cast<std::size_t>(random.integer(0, 3))],
                   &boxes[static_cast<std::size_t>(random.integer(0, 3))], Pose{}, Pose{}};
    PairMemory memory;
    for (int i = 0; i < 1000 / kShare; ++i) {
      pair.X_WB.rotation = turns[random.integer(0, 3)];
      for (int k = 0; k < 3; ++k) pair.X_WB.position[k] = 0.125 * random.integer(-10, 10);
      ASSERT_NO_FATAL_FAILURE(expectColdAnswer(pair, memory)) << run << ", " << i;
    }
  }
}

// Thirteen families in turn, so that no pair is asked twice in a row, with one memory.
TEST(AnyHistory, OfShuffledAdversarialPairs_IsNoMatter) {
  oracle::AdversarialPairs pairs(7701);
  constexpr int kFamilies = static_cast<int>(Family::kCount);
  PairMemory memory;
  for (int i = 0; i < 26000 / kShare; ++i)
    ASSERT_NO_FATAL_FAILURE(expectColdAnswer(pairs.next(static_cast<Family>(i % kFamilies)), memory)) << i;
}

// The order of the families' own, as robustness.cpp asks: many pairs there meet in several poses.
TEST(AnyHistory, OfAdversarialPairsOfOneFamily_IsNoMatter) {
  for (int f = 0; f < static_cast<int>(Family::kCount); ++f) {
    oracle::AdversarialPairs pairs(7702);
    std::map<std::pair<const ConvexPart*, const ConvexPart*>, PairMemory> memories;
    for (int i = 0; i < 2000 / kShare; ++i) {
      const PosedPair pair = pairs.next(static_cast<Family>(f));
      ASSERT_NO_FATAL_FAILURE(expectColdAnswer(pair, memories[{pair.a, pair.b}]))
          << oracle::familyName(static_cast<Family>(f)) << ' ' << i;
    }
  }
}

// Jumps of a deep pair: what was built for one pose is no help in the next, and must not cost much either.
TEST(AnyHistory, OfDeepHullsThatJump_IsForgottenBeforeItIsMended) {
  oracle::Random random(7703);
  const ConvexPart hull{oracle::randomHull(random, 250), 0.0};
  PairMemory memory;
  int grown = 0;
  for (int i = 0; i < 400 / kShare; ++i) {
    PosedPair pair{&hull, &hull, random.pose(0.5), Pose{}};
    pair.X_WB = {random.rotation(), pair.X_WA.position + random.uniform(0.0, 0.5) * random.direction()};
    ASSERT_NO_FATAL_FAILURE(expectColdAnswer(pair, memory)) << i;
    PairMemory none;
    closestFeatures(hull, pair.X_WA, hull, pair.X_WB, none);
    grown += memory.penetration.triangleCount() > none.penetration.triangleCount() + 64;
  }
  EXPECT_LT(grown, 20);
}

// Balls whose centres are a denormal apart: their distance is that of their radii, whatever the normal.
TEST(AnyHistory, OfBallsADenormalApart_LeavesNoNaN) {
  const ConvexPart ball{ConvexPolyhedron::point(Vec3::Zero()), 0.5};
  PairMemory memory;
  for (const double x : {0.0, 5e-324, 5e-319, 1e-200, 1e-160, 1e-100}) {
    const ClosestFeatures c = closestFeatures(ball, Pose{}, ball, {Quat::Identity(), Vec3(x, -x, 0)}, memory);
    EXPECT_NEAR(c.distance_m, -1.0, 1e-15) << x;
    EXPECT_NEAR(c.n_W.norm(), 1.0, 1e-14) << x;
    EXPECT_TRUE(c.p_A_W.allFinite() && c.p_B_W.allFinite()) << x;
  }
}

}  // namespace
}  // namespace carom
