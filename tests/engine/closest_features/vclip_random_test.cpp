// V-Clip against brute force on random pairs, and against proofs on adversarial ones. The seeds are fixed
// (1000 and the shard, 2000, 3000, 3100), so the number that a failure prints names its pair for good.

#include <gtest/gtest.h>

#include "engine/closest_features/vclip.h"
#include "engine/foundation/contract.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/oracle/witness_certificate.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Family;
using oracle::PlacedConvex;
using oracle::PosedPair;
using oracle::Real;

constexpr int kShare = inThisBuild(1, 20);

constexpr double kRight = 1e-9;  // relative to the pair's scale

oracle::ClaimedAnswer claim(const ClosestFeatures& c) {
  return {c.distance_m, c.p_A_W.cast<Real>(), c.p_B_W.cast<Real>(), c.n_W.cast<Real>()};
}

// ---- brute force: 100 000 pairs of 8 to 252 vertices ----

class RandomPairs : public testing::TestWithParam<int> {};

TEST_P(RandomPairs, AgreeWithBruteForce) {
  oracle::Random random(static_cast<std::uint64_t>(1000 + GetParam()));
  ConvexPart a, b;
  int separated = 0, penetrating = 0;
  for (int i = 0; i < 12500 / kShare; ++i) {
    const bool large = i % 500 == 0;
    if (large || i % 10 <= 1) {
      const int small_most =
          i % 100 < 10 ? 24 : 12;  // mostly few vertices: the oracle takes their fourth power
      const Vec3 axes(1, random.uniform(0.2, 1), random.uniform(0.2, 1));
      a.core =
          oracle::randomHull(random, large ? random.integer(30, 252) : random.integer(8, small_most), axes);
      b.core = oracle::randomHull(random, large ? random.integer(30, 252) : random.integer(8, small_most));
    }
    const Pose X_WA = random.pose(0.5);
    const Pose X_WB{random.rotation(), X_WA.position + random.uniform(0.3, 4.0) * random.direction()};
    FeaturePair tracked;
    const ClosestFeatures c = closestFeatures(a, X_WA, b, X_WB, tracked);
    ASSERT_FALSE(c.reached_limit) << i;
    const PlacedConvex pa = oracle::place(a, X_WA), pb = oracle::place(b, X_WB);
    const double size = a.core.radiusAbout(Vec3::Zero()) + b.core.radiusAbout(Vec3::Zero());
    if (c.status == Separation::kSeparated) {
      ++separated;
      ASSERT_GT(oracle::gapAlong(pa, pb, c.n_W.cast<Real>()), 0)
          << i << ": the normal does not separate them";
      ASSERT_NEAR(double(oracle::surfaceDistance(pa, pb)), c.distance_m, kRight * size) << i;
    } else if (a.core.vertexCount() <= 30 && b.core.vertexCount() <= 30) {
      ++penetrating;
      ASSERT_NEAR(double(oracle::largestAxisGap(pa, pb).gap_m), c.distance_m, kRight * size) << i;
    } else {
      ++penetrating;
      ASSERT_TRUE(oracle::intersect(pa, pb)) << i;
      ASSERT_NEAR(double(oracle::gapAlong(pa, pb, c.n_W.cast<Real>())), c.distance_m, kRight * size) << i;
    }
  }
  EXPECT_GT(separated, 3000 / kShare);
  EXPECT_GT(penetrating, 1000 / kShare);
}

INSTANTIATE_TEST_SUITE_P(VClip, RandomPairs, testing::Range(0, 8));

// ---- adversarial families ----

class AdversarialFamily : public testing::TestWithParam<Family> {
 protected:
  static int count(Family family) {
    const bool costly = family == Family::kGons || family == Family::kGeneral;
    return (costly ? 3000 : 8000) / kShare;
  }
};

// The error of a claim of separation: by the certificate, and where the normal of a near-degenerate pair is
// uncertain (the distance is flat to second order there), by brute force on the distance.
double separationError(const PlacedConvex& a, const PlacedConvex& b, const ClosestFeatures& c, double scale) {
  const auto certified = static_cast<double>(oracle::separationError(a, b, claim(c)));
  if (certified <= kRight * scale) return certified;
  return std::abs(static_cast<double>(oracle::signedGap(a, b)) - c.distance_m);
}

double penetrationError(const PlacedConvex& a, const PlacedConvex& b, const ClosestFeatures& c) {
  const Real freed = oracle::gapAlong(a, b, c.n_W.cast<Real>()) - a.radius_m - b.radius_m;
  const auto along = static_cast<double>(std::abs(freed - c.distance_m));
  if (a.vertices.size() + b.vertices.size() > 45)
    return along;  // the depth is only bounded from below, cheaply
  return std::max(along, std::abs(static_cast<double>(oracle::signedGap(a, b)) - c.distance_m));
}

// How far the witnesses of parts that are apart or touch stand out of their cores.
double witnessError(const PlacedConvex& a, const PlacedConvex& b, const ClosestFeatures& c) {
  const oracle::ClaimedAnswer answer = claim(c);
  return static_cast<double>(std::max(oracle::outside(answer.p_A - a.radius_m * answer.n, a),
                                      oracle::outside(answer.p_B + b.radius_m * answer.n, b)));
}

TEST_P(AdversarialFamily, EveryAnswerIsRight) {
  oracle::AdversarialPairs pairs(2000);
  double worst = 0.0;
  int most_states = 0;
  for (int i = 0; i < count(GetParam()); ++i) {
    const PosedPair p = pairs.next(GetParam());
    FeaturePair tracked;
    const ClosestFeatures c = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, tracked);
    ASSERT_FALSE(c.reached_limit) << i;
    ASSERT_NEAR(c.n_W.norm(), 1.0, 1e-11) << i;
    const PlacedConvex a = oracle::place(*p.a, p.X_WA), b = oracle::place(*p.b, p.X_WB);
    const double scale = p.scale() + p.X_WA.position.norm();
    const bool apart = c.distance_m > 0.0;
    const double error = (apart ? separationError(a, b, c, scale) : penetrationError(a, b, c)) / scale;
    ASSERT_LE(error, kRight) << i << ": distance " << c.distance_m;
    // Deeper than touching, the points show the depth and need not lie on both surfaces.
    const bool cores_meet = c.distance_m + a.radius_m + b.radius_m < -0.1 * kRight * scale;
    ASSERT_TRUE(cores_meet || witnessError(a, b, c) <= kRight * scale) << i << ": a witness outside its part";
    const bool proves_itself = apart || c.distance_m > -kRight * scale || a.flat() || b.flat();
    ASSERT_TRUE(proves_itself || oracle::intersect(a, b)) << i << ": no common point";
    worst = std::max(worst, error);
    most_states = std::max(most_states, c.states);
  }
  RecordProperty("worst_relative_error", printValues(worst));
  RecordProperty("most_states", most_states);
}

INSTANTIATE_TEST_SUITE_P(VClip, AdversarialFamily,
                         testing::Values(Family::kGeneral, Family::kLattice, Family::kNearlyParallel,
                                         Family::kNeedles, Family::kSizeRatio, Family::kGons,
                                         Family::kNearlyFlat, Family::kShortEdges, Family::kTouching,
                                         Family::kConcentric, Family::kFarAway, Family::kDrifted,
                                         Family::kRounded),
                         [](const auto& family) {
                           std::string name = oracle::familyName(family.param);
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

// From a random seed pair instead of a cold start: the same distance.
TEST_P(AdversarialFamily, ARandomSeedGivesTheSameDistance) {
  oracle::AdversarialPairs pairs(3000);
  const auto anyFeature = [&](const ConvexPolyhedron& p) {
    const int kinds = p.faceCount() > 0 ? 2 : p.edgeCount() > 0 ? 1 : 0;
    const auto kind = static_cast<FeatureKind>(pairs.random().integer(0, kinds));
    const int n = kind == FeatureKind::kVertex ? p.vertexCount()
                  : kind == FeatureKind::kEdge ? p.edgeCount()
                                               : p.faceCount();
    return Feature{kind, pairs.random().integer(0, n - 1)};
  };
  for (int i = 0; i < count(GetParam()); ++i) {
    const PosedPair p = pairs.next(GetParam());
    FeaturePair none, seeded{anyFeature(p.a->core), anyFeature(p.b->core)};
    const ClosestFeatures want = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, none);
    const ClosestFeatures got = closestFeatures(*p.a, p.X_WA, *p.b, p.X_WB, seeded);
    ASSERT_FALSE(got.reached_limit) << i;
    ASSERT_NEAR(got.distance_m, want.distance_m, 5e-11 * p.scale()) << i;
  }
}

// A file's coordinates are rounded, so its faces would bend, by parts in ten billion here, and leave a margin
// that looks like a shorter way. The hull flattens them: no walk is doubted where faces are almost level.
TEST(VClip, WhatAFileRoundsIsNotDoubted) {
  std::vector<Vec3> points;
  for (const Vec3& p : oracle::dodecahedronPoints()) {
    const Vec3 digits = (oracle::turned({1, 2, 3}, 0.7) * p * 1e10).array().round();
    points.push_back(digits / 1e10);
  }
  const ConvexPart solid{convexHull(points, {.coplanar_tolerance = 1e-10}).polyhedron, 0.0};
  ASSERT_EQ(solid.core.faceCount(), 12);
  oracle::Random random(3100);
  for (int i = 0; i < 20000 / kShare; ++i) {
    // A face of one almost level with a face, an edge or a corner of the other.
    const Vec3 n = solid.core.plane(random.integer(0, 11)).normal;
    const Vec3 m = i % 3 == 0   ? solid.core.plane(random.integer(0, 11)).normal
                   : i % 3 == 1 ? solid.core.vertex(random.integer(0, 19)).normalized()
                                : random.direction();
    const double tilt = std::pow(10.0, random.uniform(-14, -6));
    const Quat q = oracle::turned(random.direction(), tilt) * Quat::FromTwoVectors(m, -n);
    const Vec3 beside = 0.3 * n.cross(random.direction());
    const Pose X_WB{q, random.uniform(2.5, 4.0) * n + beside};
    FeaturePair tracked;
    const ClosestFeatures c = closestFeatures(solid, Pose{}, solid, X_WB, tracked);
    ASSERT_FALSE(c.reached_limit) << i;
  }
}

}  // namespace
}  // namespace carom
