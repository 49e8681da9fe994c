// The certificate: it accepts right answers of every kind and refuses each way of being wrong. The wrong
// answers are made from right ones, or consistently from features that are not the closest.

#include "engine/closest_features/certificate.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "engine/closest_features/pair/feature_distance.h"
#include "engine/closest_features/penetrating/penetration.h"
#include "tests/oracle/adversarial_pairs.h"
#include "tests/support/features.h"
#include "tests/support/pose_at.h"

namespace carom {
namespace {

using oracle::turned;

constexpr double kQuarter = std::numbers::pi / 4;
constexpr double kWrong = 1e-9;  // of the pair's size: three orders above what is accepted
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ConvexPart part(ConvexPolyhedron core, double radius_m = 0.0) {
  return {std::move(core), radius_m};
}
ConvexPart box(const Vec3& size_m) {
  return part(boxPolyhedron(size_m));
}
struct Query {
  std::string name;
  ConvexPart a, b;
  Pose X_WA, X_WB;

  ClosestFeatures ask(PairMemory& memory) const { return closestFeatures(a, X_WA, b, X_WB, memory); }
  double bound() const { return certifiedError(a, X_WA, b, X_WB); }
  double size() const {
    return (X_WB.position - X_WA.position).norm() + a.core.reach() + b.core.reach() + a.radius_m + b.radius_m;
  }
  Certificate judge(const ClosestFeatures& c, const PairMemory* memory) const {
    return certify(c, a, X_WA, b, X_WB, memory);
  }
  bool accepts(const ClosestFeatures& c, const PairMemory& memory) const {
    return judge(c, &memory).error_m <= bound();
  }
};

// Moved as a whole, so that no axis is the world's.
Query placed(std::string name, ConvexPart a, const Pose& X_WA, ConvexPart b, const Pose& X_WB) {
  const Pose X{turned({3, -1, 2}, 0.9), Vec3(0.3, -0.7, 0.4)};
  return {std::move(name), std::move(a), std::move(b), X * X_WA, X * X_WB};
}

std::vector<Query> separatedQueries() {
  const ConvexPart cube = box({1, 1, 1});
  const ConvexPart octahedron = part(oracle::octahedron());
  const Quat roof_x = turned(Vec3::UnitX(), kQuarter), roof_y = turned(Vec3::UnitY(), kQuarter);
  return {
      placed("vertex-vertex", cube, Pose{}, cube, poseAt(2, 3, 3)),
      placed("edge-vertex", box({1, 1, 2}), Pose{}, octahedron,
             poseAt(2, 2, 0.25, turned(Vec3::UnitZ(), kQuarter))),
      placed("vertex-edge", octahedron, poseAt(2, 2, 0.25, turned(Vec3::UnitZ(), kQuarter)), box({1, 1, 2}),
             Pose{}),
      placed("face-vertex", box({2, 2, 2}), Pose{}, octahedron, poseAt(0.2, 0.3, 3)),
      placed("vertex-face", octahedron, poseAt(0.2, 0.3, 3), box({2, 2, 2}), Pose{}),
      placed("edge-edge", cube, poseAt(0, 0, 0, roof_x), cube, poseAt(0.1, 0.2, 2, roof_y)),
      placed("edge level over a face", cube, Pose{}, cube, poseAt(0.1, 0.2, 2, roof_y)),
      placed("edges level with each other", box({1, 3, 1}), poseAt(0, 0, 0, roof_y), box({1, 3, 1}),
             poseAt(0, 0.5, 2, roof_y)),
      placed("face level over a face", cube, Pose{}, part(oracle::triangulatedBox({1, 2, 1})),
             poseAt(0.3, 0.4, 1.5, turned(Vec3::UnitZ(), 0.4))),
      placed("dodecahedron over a prism", part(oracle::dodecahedron()), Pose{},
             part(oracle::prism(60, 1.0, 1.0)), poseAt(3.1, 1.2, 0.4, turned({1, 2, 3}, 0.7))),
      placed("ball over a corner", part(ConvexPolyhedron::point(Vec3::Zero()), 0.25), poseAt(2, 3, 3), cube,
             Pose{}),
      placed("capsules crossed", part(ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.25), Pose{},
             part(ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.2),
             poseAt(1, 0.3, 0.2, turned(Vec3::UnitX(), 1.0))),
  };
}

std::vector<Query> penetratingQueries() {
  const ConvexPart cube = box({1, 1, 1});
  const Quat roof_x = turned(Vec3::UnitX(), kQuarter), roof_y = turned(Vec3::UnitY(), kQuarter);
  return {
      placed("through a face", cube, Pose{}, cube, poseAt(0.7, 0.1, 0.2, turned(Vec3::UnitX(), 0.3))),
      placed("through crossing edges", cube, poseAt(0, 0, 0, roof_x), cube, poseAt(0.1, 0.1, 1.1, roof_y)),
      placed("by a corner", box({2, 2, 2}), Pose{}, part(oracle::octahedron()), poseAt(0.2, 0.3, 1.7)),
      placed("level faces", cube, Pose{}, box({1, 2, 1}), poseAt(0.1, 0.2, 0.8)),
      placed("almost one centre", part(oracle::dodecahedron()), Pose{}, part(oracle::dodecahedron()),
             poseAt(0.1, 0.05, 0.02, turned({1, 2, 3}, 0.7))),
      placed("one pose", box({1, 0.4, 2}), Pose{}, box({1, 0.4, 2}), Pose{}),
      placed("a capsule's axis in a box", box({2, 2, 2}), Pose{},
             part(ConvexPolyhedron::segment({0, 0, -1}, {0, 0, 1}), 0.25),
             poseAt(0.8, 0.1, 0.2, turned(Vec3::UnitX(), 0.3))),
  };
}

std::vector<Query> allQueries() {
  std::vector<Query> all = separatedQueries();
  for (Query& q : penetratingQueries()) all.push_back(std::move(q));
  return all;
}

// What a wrong claim is made from, and the mistake.
using Mistake = std::function<void(const Query&, ClosestFeatures&)>;

// Every query's answer with the mistake in it is refused, with an error of at least `share` of kWrong sizes.
void expectRefused(const std::vector<Query>& queries, const Mistake& makeMistake, double share) {
  for (const Query& q : queries) {
    PairMemory memory;
    ClosestFeatures claim = q.ask(memory);
    ASSERT_TRUE(q.accepts(claim, memory)) << q.name;
    makeMistake(q, claim);
    EXPECT_GE(q.judge(claim, &memory).error_m, share * kWrong * q.size()) << q.name;
    EXPECT_FALSE(q.accepts(claim, memory)) << q.name;
  }
}

Vec3 acrossTo(const Vec3& n) {
  return tangentBasis(n).t1;
}

// ---- right answers ----

TEST(Certificate, AcceptsEveryKindOfFeaturePair) {
  for (const Query& q : separatedQueries()) {
    PairMemory memory;
    const ClosestFeatures c = q.ask(memory);
    ASSERT_EQ(c.status, Separation::kSeparated) << q.name;
    const Certificate certificate = q.judge(c, &memory);
    EXPECT_TRUE(certificate.complete) << q.name;
    EXPECT_LE(certificate.error_m, q.bound()) << q.name;
  }
}

TEST(Certificate, KindsMeantAreKindsAsked) {
  const auto kinds = [](const Query& q) {
    PairMemory memory;
    const FeaturePair f = q.ask(memory).features;
    return std::array{f.a.kind, f.b.kind};
  };
  constexpr FeatureKind v = FeatureKind::kVertex, e = FeatureKind::kEdge, f = FeatureKind::kFace;
  const std::vector<Query> queries = separatedQueries();
  const std::array<FeatureKind, 2> meant[] = {{v, v}, {e, v}, {v, e}, {f, v}, {v, f}, {e, e}};
  for (std::size_t i = 0; i < std::size(meant); ++i)
    EXPECT_EQ(kinds(queries[i]), meant[i]) << queries[i].name;
}

TEST(Certificate, AcceptsAnExactDepthAndProvesItTheLeast) {
  for (const Query& q : penetratingQueries()) {
    PairMemory memory;
    const ClosestFeatures c = q.ask(memory);
    ASSERT_EQ(c.status, Separation::kPenetrating) << q.name;
    const Certificate certificate = q.judge(c, &memory);
    EXPECT_TRUE(certificate.complete) << q.name;
    EXPECT_LE(certificate.error_m, q.bound()) << q.name;
  }
}

TEST(Certificate, WithoutAPolytope_ADepthIsOnlyProvenToFree) {
  for (const Query& q : penetratingQueries()) {
    PairMemory memory;
    const ClosestFeatures c = q.ask(memory);
    const Certificate certificate = q.judge(c, nullptr);
    EXPECT_FALSE(certificate.complete) << q.name;
    EXPECT_LE(certificate.error_m, q.bound()) << q.name;
  }
}

TEST(Certificate, AcceptsATouch) {
  const Query touches[] = {
      placed("corner", box({2, 2, 2}), Pose{}, part(oracle::octahedron()), poseAt(0.25, 0.125, 2)),
      placed("faces", box({1, 1, 1}), Pose{}, box({1, 1, 1}), poseAt(0.25, 0.25, 1)),
      placed("edges", box({1, 1, 1}), poseAt(0, 0, 0, turned(Vec3::UnitX(), kQuarter)), box({1, 1, 1}),
             poseAt(0.1, 0.2, std::numbers::sqrt2, turned(Vec3::UnitY(), kQuarter)))};
  for (const Query& q : touches) {
    PairMemory memory;
    const ClosestFeatures c = q.ask(memory);
    EXPECT_NEAR(c.distance_m, 0.0, 1e-14) << q.name;
    EXPECT_TRUE(q.accepts(c, memory)) << q.name;
  }
}

// ---- wrong answers ----

TEST(Certificate, RefusesAGapThatIsOff_AloneOrWithTheWitnessMovedAlong) {
  for (const double sign : {-1.0, 1.0}) {
    expectRefused(
        allQueries(), [&](const Query& q, ClosestFeatures& c) { c.distance_m += sign * kWrong * q.size(); },
        0.99);
    expectRefused(
        allQueries(),
        [&](const Query& q, ClosestFeatures& c) {
          c.distance_m += sign * kWrong * q.size();
          c.p_B_W = c.p_A_W + c.distance_m * c.n_W;
        },
        0.99);
  }
}

TEST(Certificate, RefusesATiltedNormal_AloneOrWithTheWitnessMovedAlong) {
  const auto tilt = [](const Query& q, ClosestFeatures& c) {
    const double radians = kWrong * q.size() / std::abs(c.distance_m);
    c.n_W = turned(acrossTo(c.n_W), radians) * c.n_W;
  };
  expectRefused(allQueries(), tilt, 0.99);
  expectRefused(
      allQueries(),
      [&](const Query& q, ClosestFeatures& c) {
        tilt(q, c);
        c.p_B_W = c.p_A_W + c.distance_m * c.n_W;
      },
      0.1);
}

TEST(Certificate, RefusesANormalThatIsNotUnitOrPointsFromBToA) {
  expectRefused(
      allQueries(),
      [](const Query& q, ClosestFeatures& c) { c.n_W *= 1.0 + kWrong * q.size() / std::abs(c.distance_m); },
      0.99);
  expectRefused(
      allQueries(), [](const Query&, ClosestFeatures& c) { c.n_W = -c.n_W; }, 1e6);
}

// A witness is moved along its body's surface, across the normal.
TEST(Certificate, RefusesAWitnessOffItsFeature) {
  for (const bool on_a : {true, false})
    for (const double sign : {-1.0, 1.0})
      expectRefused(
          allQueries(),
          [&](const Query& q, ClosestFeatures& c) {
            (on_a ? c.p_A_W : c.p_B_W) += sign * kWrong * q.size() * acrossTo(c.n_W);
          },
          0.99);
}

TEST(Certificate, RefusesWitnessesThatAreBothMovedOutOfTheirParts) {
  // Along the normal, apart: the one leaves A, or the other B, by the cosine to a face of the corner. Of an
  // overlap the points may lie deeper.
  for (const double sign : {-1.0, 1.0})
    expectRefused(
        separatedQueries(),
        [&](const Query& q, ClosestFeatures& c) {
          c.p_A_W += sign * kWrong * q.size() * c.n_W;
          c.p_B_W += sign * kWrong * q.size() * c.n_W;
        },
        0.5);
  // Across it, by more than any feature is long.
  expectRefused(
      allQueries(),
      [](const Query&, ClosestFeatures& c) {
        const Vec3 far = 4.0 * acrossTo(c.n_W);
        c.p_A_W += far;
        c.p_B_W += far;
      },
      1e6);
}

// The answer that two features would have if they were the closest: consistent in itself.
ClosestFeatures claimFrom(const Query& q, const FeatureDistance& d) {
  const Vec3 n = (d.p_b - d.p_a) / d.distance();
  ClosestFeatures claim;
  claim.distance_m = d.distance() - q.a.radius_m - q.b.radius_m;
  claim.n_W = q.X_WA.rotation * n;
  claim.p_A_W = q.X_WA * (d.p_a + q.a.radius_m * n);
  claim.p_B_W = q.X_WA * (d.p_b - q.b.radius_m * n);
  claim.features = d.features;
  return claim;
}

// Each claims its own closest points; those of the other side, of a neighbour, of a local minimum.
TEST(Certificate, OfAllFeaturePairsOnlyThoseAsNearAsTheAnswerAreAccepted) {
  int refused = 0, accepted = 0;
  for (const Query& q : separatedQueries()) {
    PairMemory memory;
    const ClosestFeatures right = q.ask(memory);
    const PolyhedronPair pair(q.a.core, q.X_WA, q.b.core, q.X_WB);
    for (const Feature& fa : allFeatures(q.a.core))
      for (const Feature& fb : allFeatures(q.b.core)) {
        if (fa.kind == FeatureKind::kFace && fb.kind == FeatureKind::kFace) continue;
        const FeatureDistance d = featureDistance(pair, {fa, fb});
        if (d.crossing || d.squared_m2 == 0.0) continue;
        const ClosestFeatures claim = claimFrom(q, d);
        const double excess = claim.distance_m - right.distance_m;
        const Certificate certificate = q.judge(claim, &memory);
        if (excess > kWrong * q.size()) {
          ++refused;
          ASSERT_GE(certificate.error_m, 0.99 * excess) << q.name;
        } else {
          ++accepted;
          ASSERT_LE(certificate.error_m, q.bound()) << q.name;
        }
      }
  }
  EXPECT_GT(refused, 10000);
  EXPECT_GT(accepted, 100);
}

// The two cubes of triangles on which the classic implementation answers 1.5 from below a flat edge.
TEST(Certificate, RefusesTheLocalMinimumBehindAFlatEdge) {
  const ConvexPart cube = part(oracle::triangulatedBox({1, 1, 1}));
  const Query q{"", cube, cube, Pose{}, poseAt(1.5, -0.375, 0.375, turned(Vec3::UnitZ(), std::numbers::pi))};
  PairMemory memory;
  ClosestFeatures c = q.ask(memory);
  ASSERT_NEAR(c.distance_m, 0.5, 1e-15);
  c.p_A_W.x() = -0.5;
  c.distance_m = 1.5;
  EXPECT_GE(q.judge(c, &memory).error_m, 1.0);
}

// The exact depth along each face normal, with witnesses that show it: each frees the parts, one is least.
TEST(Certificate, RefusesTheDepthOfAnAxisThatIsNotTheLeast) {
  int refused = 0;
  for (const Query& q : penetratingQueries()) {
    PairMemory memory;
    const ClosestFeatures right = q.ask(memory);
    const PolyhedronPair pair(q.a.core, q.X_WA, q.b.core, q.X_WB);
    const auto claimAlong = [&](const MinimumTranslation& m) {
      ClosestFeatures claim = right;
      claim.distance_m = m.gap_m - q.a.radius_m - q.b.radius_m;
      claim.n_W = q.X_WA.rotation * m.normal;
      claim.p_A_W = q.X_WA * Vec3(m.p_a + q.a.radius_m * m.normal);
      claim.p_B_W = q.X_WA * Vec3(m.p_b - q.b.radius_m * m.normal);
      const double excess = right.distance_m - claim.distance_m;
      if (excess < kWrong * q.size()) return;
      ++refused;
      EXPECT_GE(q.judge(claim, &memory).error_m, 0.99 * excess) << q.name;
    };
    for (int f = 0; f < q.a.core.faceCount(); ++f) claimAlong(gapOverFaceOfA(pair, f, 0));
    for (int f = 0; f < q.b.core.faceCount(); ++f) claimAlong(gapOverFaceOfB(pair, f, 0));
  }
  EXPECT_GT(refused, 50);
}

// The corners are looked up anew: a polytope of an earlier pose proves what it still encloses, no more.
TEST(Certificate, APolytopeOfAnotherPose_DoesNotProveATooLargeDepth) {
  const ConvexPart cube = box({1, 1, 1});
  const Query deep = placed("", cube, Pose{}, cube, poseAt(0.3, 0.05, 0.02, turned({1, 2, 3}, 0.3)));
  const Query shallow = placed("", cube, Pose{}, cube, poseAt(0.8, 0.05, 0.02, turned({1, 2, 3}, 0.3)));
  PairMemory of_deep, of_shallow;
  deep.ask(of_deep);
  ClosestFeatures c = shallow.ask(of_shallow);
  const double depth = -c.distance_m;
  // Out by the other side: the way is free, but far longer than the least.
  const double width = depth + 2.0 * 0.8;
  c.n_W = -c.n_W;
  c.distance_m = -width;
  EXPECT_GE(shallow.judge(c, &of_deep).error_m, width - depth - 0.1);
}

TEST(Certificate, RefusesNaNInAnyPartOfAnAnswer) {
  for (const Query& q : {separatedQueries()[5], penetratingQueries()[0]}) {
    PairMemory memory;
    const ClosestFeatures right = q.ask(memory);
    const auto expectRefusal = [&](const char* where, auto&& spoil) {
      ClosestFeatures c = right;
      spoil(c);
      EXPECT_FALSE(q.accepts(c, memory)) << q.name << ": " << where;
    };
    expectRefusal("distance", [](ClosestFeatures& c) { c.distance_m = kNaN; });
    for (int i = 0; i < 3; ++i) {
      expectRefusal("witness of A", [i](ClosestFeatures& c) { c.p_A_W[i] = kNaN; });
      expectRefusal("witness of B", [i](ClosestFeatures& c) { c.p_B_W[i] = kNaN; });
      expectRefusal("normal", [i](ClosestFeatures& c) { c.n_W[i] = kNaN; });
    }
    expectRefusal("witnesses", [](ClosestFeatures& c) { c.p_A_W = c.p_B_W = Vec3::Constant(kNaN); });
    Query nowhere = q;
    nowhere.X_WB.position.x() = kNaN;
    EXPECT_FALSE(nowhere.judge(right, &memory).error_m <= q.bound()) << q.name << ": pose";
  }
}

// ---- the bound ----

TEST(Certificate, ItsBoundIsATrillionthOfTheSizeAndTheRoundingOfThePositions) {
  const ConvexPart cube = box({1, 1, 1});
  const double reaches = 2.0 * cube.core.reach();
  EXPECT_DOUBLE_EQ(certifiedError(cube, Pose{}, cube, poseAt(0, 3, 4)),
                   1e-12 * (5.0 + reaches) + 5.0 * 0x1p-50);
  const ConvexPart rounded = part(cube.core, 0.5);
  EXPECT_DOUBLE_EQ(certifiedError(cube, poseAt(0, 3, 4), rounded, poseAt(0, 3, 4)),
                   1e-12 * (reaches + 0.5) + 10.0 * 0x1p-50);
}

}  // namespace
}  // namespace carom
