// A search may begin anywhere: features remembered from a pose that has nothing to do with this one lead to
// the answer of a cold start. Lattice poses are the hard ones, where a walk can stop between borders of
// V-regions.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "engine/closest_features/certificate.h"
#include "engine/closest_features/vclip.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Family;

constexpr int kPairs = inThisBuild(10'000, 500);

double trueGap(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB) {
  return static_cast<double>(oracle::signedGap(oracle::place(a, X_WA), oracle::place(b, X_WB)));
}

// Apart by 0.8749: the walk from these features finds no way on 1.54 m from touching.
TEST(StaleSeed, OnALattice_GivesTheTrueDistance) {
  const ConvexPart a{oracle::triangulatedBox({2, 2, 0.5}), 0.0};
  const ConvexPart b{boxPolyhedron({0.5, 1, 0.25}), 0.0};
  const double h = std::numbers::sqrt2 / 2;
  const Pose X_WA{Quat(h, h, 0, 0), Vec3::Zero()};
  const Pose X_WB{Quat(-0.65328148243790163, -0.65328148243790174, -0.2705980500729796, -0.27059805007297971),
                  Vec3(-1.25, -1.375, 1.25)};
  PairMemory memory;
  memory.features = {edgeFeature(6), faceFeature(2)};
  EXPECT_NEAR(closestFeatures(a, X_WA, b, X_WB, memory).distance_m, trueGap(a, X_WA, b, X_WB), 1e-14);
}

// Boxes that overlap by 0.125: from every pair of edges the depth is found, never a distance.
TEST(StaleSeed, OfOverlappingBoxesOnALattice_FindsTheDepth) {
  const ConvexPart a{oracle::triangulatedBox({0.5, 1, 0.25}), 0.0};
  const ConvexPart b{boxPolyhedron({2, 2, 0.5}), 0.0};
  const Pose X_WA{
      Quat(-5.5511151231257827e-17, -1.6653345369377348e-16, -0.70710678118654746, -0.70710678118654746),
      Vec3::Zero()};
  const Pose X_WB{Quat(0.70710678118654757, 0, 0.70710678118654746, 0), Vec3(-0.25, 1, 0.125)};
  const double want = trueGap(a, X_WA, b, X_WB);
  EXPECT_NEAR(want, -0.125, 1e-14);
  for (int i = 0; i < a.core.edgeCount(); ++i)
    for (int j = 0; j < b.core.edgeCount(); ++j) {
      PairMemory memory;
      memory.features = {edgeFeature(i), edgeFeature(j)};
      ASSERT_NEAR(closestFeatures(a, X_WA, b, X_WB, memory).distance_m, want, 1e-14) << i << ", " << j;
    }
}

Feature anyFeature(oracle::Random& random, const ConvexPolyhedron& p) {
  const int kind = random.integer(0, p.faceCount() > 0 ? 2 : p.edgeCount() > 0 ? 1 : 0);
  if (kind == 0) return vertexFeature(random.integer(0, p.vertexCount() - 1));
  if (kind == 1) return edgeFeature(random.integer(0, p.edgeCount() - 1));
  return faceFeature(random.integer(0, p.faceCount() - 1));
}

class StaleSeedOf : public testing::TestWithParam<Family> {};

// Certified, of the class and the distance of a cold start, from five pairs of features drawn at random.
TEST_P(StaleSeedOf, LeadsToTheAnswerOfAColdStart) {
  oracle::AdversarialPairs pairs(3107);
  oracle::Random random(3108);
  for (int i = 0; i < kPairs; ++i) {
    const oracle::PosedPair p = pairs.next(GetParam());
    PairMemory cold;
    const ClosestFeatures want = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, cold);
    const double bound = certifiedError(*p.a, p.X_WA, *p.b, p.X_WB);
    for (int k = 0; k < 5; ++k) {
      PairMemory stale;
      const Feature on_a = anyFeature(random, p.a->core), on_b = anyFeature(random, p.b->core);
      stale.features = {on_a, on_b};
      const ClosestFeatures c = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, stale);
      ASSERT_EQ(c.status, want.status) << "pair " << i;
      ASSERT_NEAR(c.distance_m, want.distance_m, 5 * 0x1p-52 * p.scale()) << "pair " << i;
      ASSERT_FALSE(c.reached_limit) << "pair " << i;
      ASSERT_LE(certify(c, *p.a, p.X_WA, *p.b, p.X_WB, &stale).error_m, bound) << "pair " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, StaleSeedOf,
                         testing::Values(Family::kGeneral, Family::kLattice, Family::kNeedles,
                                         Family::kNearlyFlat, Family::kFarAway, Family::kDrifted),
                         [](const auto& family) {
                           std::string name = oracle::familyName(family.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace carom
