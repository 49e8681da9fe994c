// The tracked depth against the full search over the separating axes, in double (penetration.h) and in long
// double (tests/oracle), and along motions: the signed distance of two bodies changes by no more than the
// farthest that a point of one moves against the other. Seeds 7300 to 7335.

#include "engine/closest_features/penetrating/inner_polytope.h"

#include <gtest/gtest.h>

#include "engine/closest_features/certificate.h"
#include "engine/closest_features/vclip.h"
#include "tests/oracle/brute_force_distance.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"
#include "tests/support/features.h"

namespace carom {
namespace {

using oracle::Random;

constexpr int kShare = inThisBuild(1, 40);

// What rounding may do within a query: the two bounds of a depth meet to within that, and each is as much
// off.
double noiseOf(const PolyhedronPair& pair) {
  return 0x1p-47 * sizeOf(pair);
}

// ---- exact ----

enum class Overlap { kShallow, kDeep, kOneCentre, kOnePose, kInside };

struct OverlappingPair {
  ConvexPart a, b;
  Pose X_WA, X_WB;
  PolyhedronPair pair() const { return {a.core, X_WA, b.core, X_WB}; }
};

ConvexPolyhedron scaled(const ConvexPolyhedron& p, double factor) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : p.vertices()) vertices.push_back(factor * v);
  return convexHull(vertices).polyhedron;
}

// From 0 to 1 % of the size into each other, wherever they meet on the way.
Pose pushedIn(OverlappingPair at, Random& random) {
  const Vec3 way = random.direction();
  at.X_WB.position = at.X_WA.position + 4.0 * way;
  PairMemory memory;
  for (int i = 0; i < 100; ++i) {
    const double gap = closestFeatures(at.a, at.X_WA, at.b, at.X_WB, memory).distance_m;
    if (gap < 1e-9) break;
    at.X_WB.position -= gap * way;
  }
  at.X_WB.position -= random.logUniform(1e-8, 1e-2) * way;
  return at.X_WB;
}

OverlappingPair overlapping(Overlap how, int n_a, int n_b, Random& random) {
  OverlappingPair at;
  at.a.core = oracle::randomHull(random, n_a, Vec3(1, random.uniform(0.3, 1), random.uniform(0.3, 1)));
  at.b.core = oracle::randomHull(random, n_b, Vec3(1, random.uniform(0.3, 1), random.uniform(0.3, 1)));
  at.X_WA = random.pose(0.5);
  at.X_WB = {random.rotation(), at.X_WA.position};
  if (how == Overlap::kShallow) at.X_WB = pushedIn(at, random);
  if (how == Overlap::kDeep) at.X_WB.position += random.uniform(0.0, 0.3) * random.direction();
  if (how == Overlap::kOnePose) {
    at.b = at.a;
    at.X_WB = at.X_WA;
  }
  if (how == Overlap::kInside) {
    at.b.core = scaled(at.b.core, random.logUniform(1e-3, 0.1));
    at.X_WB.position += 0.1 * random.direction();
  }
  return at;
}

class ExactDepth : public testing::TestWithParam<Overlap> {};

TEST_P(ExactDepth, IsTheFullSearchOverTheSeparatingAxes) {
  Random random(7300 + static_cast<std::uint64_t>(GetParam()));
  int penetrating = 0;
  for (int i = 0; i < 400 / kShare; ++i) {
    const bool large = i % 40 == 39;
    const OverlappingPair at = overlapping(GetParam(), random.integer(4, large ? 252 : 32),
                                           random.integer(4, large ? 252 : 32), random);
    const PolyhedronPair pair = at.pair();
    InnerPolytope polytope;
    const MinimumTranslation m = polytope.minimumTranslation(pair, noiseOf(pair));
    const MinimumTranslation want = largestGap(pair);
    if (want.gap_m > -4.0 * noiseOf(pair)) continue;
    ++penetrating;
    ASSERT_NEAR(m.gap_m, want.gap_m, 2.0 * noiseOf(pair)) << i;
    ASSERT_NEAR(m.normal.norm(), 1.0, 1e-15) << i;
    ASSERT_LT((m.p_b - m.p_a - m.gap_m * m.normal).norm(), 2.0 * noiseOf(pair)) << i;
    ASSERT_GE(polytope.provenDepth(), -m.gap_m - 2.0 * noiseOf(pair)) << i;
    ASSERT_GE(polytope.triangleCount(), 4) << i;
  }
  EXPECT_GT(penetrating, 300 / kShare);
}

TEST_P(ExactDepth, OfAQuery_IsTheLongDoubleOraclesAndItsNormalFreesTheBodies) {
  Random random(7310 + static_cast<std::uint64_t>(GetParam()));
  for (int i = 0; i < 120 / kShare; ++i) {
    const OverlappingPair at = overlapping(GetParam(), random.integer(4, 20), random.integer(4, 20), random);
    PairMemory memory;
    const ClosestFeatures c = closestFeatures(at.a, at.X_WA, at.b, at.X_WB, memory);
    const oracle::PlacedConvex a = oracle::place(at.a, at.X_WA), b = oracle::place(at.b, at.X_WB);
    const auto want = static_cast<double>(oracle::largestAxisGap(a, b).gap_m);
    if (want >= 0.0) continue;
    const double tolerance = 4.0 * noiseOf(at.pair());
    ASSERT_NEAR(c.distance_m, want, tolerance) << i;
    ASSERT_NEAR(static_cast<double>(oracle::gapAlong(a, b, c.n_W.cast<oracle::Real>())), want, tolerance)
        << i;
    ASSERT_FALSE(c.reached_limit) << i;
  }
}

std::string overlapName(const testing::TestParamInfo<Overlap>& how) {
  static const char* names[] = {"Shallow", "Deep", "OneCentre", "OnePose", "Inside"};
  return names[static_cast<std::size_t>(how.param)];
}
INSTANTIATE_TEST_SUITE_P(InnerPolytope, ExactDepth,
                         testing::Values(Overlap::kShallow, Overlap::kDeep, Overlap::kOneCentre,
                                         Overlap::kOnePose, Overlap::kInside),
                         overlapName);

// ---- tracked ----

TEST(TrackedDepth, IsTheUntrackedOne_WhateverTheStep) {
  Random random(7320);
  int tracked_on = 0, penetrating = 0;
  for (int run = 0; run < 40; ++run) {
    OverlappingPair at = overlapping(Overlap::kDeep, random.integer(4, 62), random.integer(4, 62), random);
    PairMemory memory;
    for (int i = 0; i < 500 / kShare; ++i) {
      const double step = random.logUniform(1e-9, 0.5);
      at.X_WB.rotation = (oracle::turned(random.direction(), step) * at.X_WB.rotation).normalized();
      at.X_WB.position =
          at.X_WA.position + 0.97 * (at.X_WB.position - at.X_WA.position) + step * random.direction();
      tracked_on += memory.penetration.triangleCount() > 0;
      const ClosestFeatures tracked = closestFeatures(at.a, at.X_WA, at.b, at.X_WB, memory);
      PairMemory fresh;
      const ClosestFeatures cold = closestFeatures(at.a, at.X_WA, at.b, at.X_WB, fresh);
      ASSERT_NEAR(tracked.distance_m, cold.distance_m, 2.0 * noiseOf(at.pair())) << run << ", step " << i;
      ASSERT_EQ(tracked.status, cold.status) << run << ", step " << i;
      penetrating += cold.status == Separation::kPenetrating;
    }
  }
  EXPECT_GT(tracked_on, 10000 / kShare);
  EXPECT_GT(penetrating, 10000 / kShare);
}

TEST(TrackedDepth, OfASmallStep_CostsFewExpansions) {
  Random random(7321);
  OverlappingPair at = overlapping(Overlap::kDeep, 252, 252, random);
  InnerPolytope polytope;
  polytope.minimumTranslation(at.pair(), noiseOf(at.pair()));
  const int cold = polytope.expansions();
  int warm = 0;
  for (int i = 0; i < 1000; ++i) {
    at.X_WB.position += 1e-6 * random.direction();
    polytope.minimumTranslation(at.pair(), noiseOf(at.pair()));
    warm += polytope.expansions();
  }
  EXPECT_GT(cold, 10);
  EXPECT_LT(warm, 1000);
}

// Points of former poses are given up in time, though each time costs a new polytope.
TEST(TrackedDepth, OfABodyThatTurnsOn_KeepsAPolytopeNearlyAsSmallAsANewOne) {
  Random random(7322);
  long tracked = 0, made_anew = 0;
  for (int run = 0; run < 10; ++run) {
    const ConvexPolyhedron a = oracle::randomHull(random, 32), b = oracle::randomHull(random, 32);
    const Quat turn = oracle::turned(random.direction(), 0.01);
    Pose X_AB{random.rotation(), 0.1 * random.direction()};
    InnerPolytope polytope;
    for (int i = 0; i < 600 / kShare; ++i) {
      X_AB.rotation = (turn * X_AB.rotation).normalized();
      const PolyhedronPair pair(a, Pose{}, b, X_AB);
      InnerPolytope other;
      polytope.minimumTranslation(pair, noiseOf(pair));
      other.minimumTranslation(pair, noiseOf(pair));
      tracked += polytope.triangleCount();
      made_anew += other.triangleCount();
    }
  }
  EXPECT_LT(static_cast<double>(tracked), 1.25 * static_cast<double>(made_anew))
      << tracked << " triangles, " << made_anew;
}

// ---- continuous ----

// A smooth way of B about A: positions on a curve of three periods, rotations about two axes.
struct Way {
  double middle_m, swing_m;
  Pose at(double phase) const {
    const Vec3 towards =
        Vec3(std::sin(phase), std::cos(1.3 * phase), std::sin(0.7 * phase + 1.0)).normalized();
    return {oracle::turned(Vec3(1, 2, 3), 2.1 * phase) * oracle::turned(Vec3(-2, 1, 0.5), 1.7 * phase),
            (middle_m + swing_m * std::sin(5.0 * phase)) * towards};
  }
};

// The farthest that a point of the body moves between two poses, at most: by translation, and by a rotation
// whose chord at distance r is 2 r sin(angle / 2).
double motionBound(const ConvexPolyhedron& body, const Pose& from, const Pose& to) {
  const Vec3 chord = (to.rotation * from.rotation.conjugate()).vec();
  return (to.position - from.position).norm() + 2.0 * chord.norm() * body.radiusAbout(Vec3::Zero());
}

struct Walked {
  int penetrating = 0;
  int separated = 0;
  int crossings = 0;
  int switches = 0;  // of the normal, by more than 0.1
  double largest_excess_m = -1.0;
  int at_step = -1;
};

// The largest excess of a change of the signed distance over the motion bound, with one memory all along.
Walked walkAlong(const ConvexPart& a, const ConvexPart& b, const Way& way, double step, int steps) {
  Walked walked;
  PairMemory memory;
  const Pose X_WA;
  Pose last_pose = way.at(0.0);
  ClosestFeatures last = closestFeatures(a, X_WA, b, last_pose, memory);
  for (int i = 1; i <= steps; ++i) {
    const Pose pose = way.at(i * step);
    const ClosestFeatures now = closestFeatures(a, X_WA, b, pose, memory);
    const double excess = std::abs(now.distance_m - last.distance_m) - motionBound(b.core, last_pose, pose);
    if (excess > walked.largest_excess_m) {
      walked.largest_excess_m = excess;
      walked.at_step = i;
    }
    ++(now.distance_m < 0.0 ? walked.penetrating : walked.separated);
    walked.crossings += (now.distance_m < 0.0) != (last.distance_m < 0.0);
    walked.switches += (now.n_W - last.n_W).norm() > 0.1;
    last = now;
    last_pose = pose;
  }
  return walked;
}

// Twice what rounding may put into a distance by the certificate, once for each of the two.
double allowedExcess(const ConvexPart& a, const ConvexPart& b, const Way& way) {
  const Pose far{Quat::Identity(), Vec3(way.middle_m + way.swing_m, 0, 0)};
  return 2.0 * certifiedError(a, Pose{}, b, far);
}

TEST(DepthAlongAMillionSmallSteps, ChangesByNoMoreThanTheMotion) {
  Random random(7330);
  const ConvexPart a{oracle::randomHull(random, 20, Vec3(1, 0.7, 0.8)), 0.0};
  const ConvexPart b{oracle::dodecahedron(), 0.0};
  const Way way{0.6, 0.5};
  const Walked walked = walkAlong(a, b, way, 2e-5, 1000000 / kShare);
  EXPECT_LE(walked.largest_excess_m, allowedExcess(a, b, way)) << "at step " << walked.at_step;
  EXPECT_EQ(walked.separated, 0);
#ifdef __OPTIMIZE__
  EXPECT_GT(walked.switches, 20) << "the way out changed rarely";
#endif
}

TEST(SignedDistance, InAndOutAgain_CrossesZeroByNoMoreThanTheMotion) {
  Random random(7331);
  const ConvexPart a{oracle::randomHull(random, 30), 0.0};
  const ConvexPart b{oracle::randomHull(random, 14, Vec3(1, 0.5, 0.7)), 0.0};
  const Way way{1.4, 0.6};
  for (const double step : {1e-3, 1e-4}) {
    const Walked walked = walkAlong(a, b, way, step, 100000 / kShare);
    EXPECT_LE(walked.largest_excess_m, allowedExcess(a, b, way)) << "at step " << walked.at_step;
    EXPECT_GT(walked.crossings, 100000 / kShare * step);
    EXPECT_GT(walked.penetrating, 1000 / kShare);
    EXPECT_GT(walked.separated, 1000 / kShare);
  }
}

// Along a face's normal the signed distance is the coordinate itself, to rounding, on both sides of zero.
TEST(SignedDistance, OfAFaceOverAFace_IsTheHeightThroughZero) {
  const ConvexPart box{boxPolyhedron({1, 1, 1}), 0.0};
  PairMemory memory;
  for (int direction : {1, -1})
    for (int i = -3000; i <= 3000; ++i) {
      // From 1e-1 down to 1e-16 and through zero to as much on the other side.
      const double height =
          i == 0 ? 0.0
                 : (direction * i > 0 ? 1.0 : -1.0) * std::pow(10.0, -16.0 + 15.0 * std::abs(i) / 3000.0);
      const Pose X_WB{Quat::Identity(), Vec3(0.3, 0.2, 1.0 + height)};
      const double want = X_WB.position.z() - 1.0;
      ASSERT_NEAR(closestFeatures(box, Pose{}, box, X_WB, memory).distance_m, want, 1e-15) << height;
    }
}

// The depth against the long double oracle at poses along the way, tracked all the way there.
TEST(DepthAlongAWay, IsTheOraclesAtEveryThousandthStep) {
  Random random(7332);
  const ConvexPart a{oracle::randomHull(random, 16), 0.0};
  const ConvexPart b{oracle::randomHull(random, 12, Vec3(1, 0.5, 0.7)), 0.0};
  const Way way{0.6, 0.5};
  PairMemory memory;
  for (int i = 0; i < 200000 / kShare; ++i) {
    const Pose X_WB = way.at(i * 1e-4);
    const ClosestFeatures c = closestFeatures(a, Pose{}, b, X_WB, memory);
    if (i % 1000 != 999) continue;
    const oracle::Real want = oracle::signedGap(oracle::place(a, Pose{}), oracle::place(b, X_WB));
    ASSERT_NEAR(c.distance_m, static_cast<double>(want), certifiedError(a, Pose{}, b, X_WB)) << i;
  }
}

// ---- switches at symmetric poses ----

// Two unit cubes, B at (x, y, 0): the depth is 1 - max(|x|, |y|), and at |x| = |y| the way out turns.
TEST(EscapeDirection, SwitchesBetweenTwoFacesWithoutAJumpInDepth) {
  const ConvexPart box{boxPolyhedron({1, 1, 1}), 0.0};
  PairMemory memory;
  Vec3 last = Vec3::UnitX();
  int switches = 0;
  for (int i = -1000; i <= 1000; ++i) {
    const double s = 1e-4 * i;
    const Pose X_WB{Quat::Identity(), Vec3(0.3 - s, 0.3 + s, 0.0)};
    const ClosestFeatures c = closestFeatures(box, Pose{}, box, X_WB, memory);
    ASSERT_NEAR(c.distance_m, std::max(X_WB.position.x(), X_WB.position.y()) - 1.0, 1e-15) << i;
    ASSERT_NEAR(c.n_W.lpNorm<Eigen::Infinity>(), 1.0, 1e-15) << i;
    switches += (c.n_W - last).norm() > 0.5;
    last = c.n_W;
  }
  EXPECT_EQ(switches, 1);
  EXPECT_LT((last - Vec3::UnitY()).norm(), 1e-15);
}

// Through one centre the way out turns round: depth 1 - |s|.
TEST(EscapeDirection, TurnsRoundAtTheCommonCentreWithoutAJumpInDepth) {
  const ConvexPart box{boxPolyhedron({1, 1, 1}), 0.0};
  PairMemory memory;
  for (int i = -2000; i <= 2000; ++i) {
    const double s =
        i == 0 ? 0.0 : (i > 0 ? 1.0 : -1.0) * std::pow(10.0, -17.0 + 16.0 * std::abs(i) / 2000.0);
    const ClosestFeatures c = closestFeatures(box, Pose{}, box, {Quat::Identity(), Vec3(0, 0, s)}, memory);
    // Within the noise both ways are equally near, and either answers.
    const PolyhedronPair pair(box.core, Pose{}, box.core, {Quat::Identity(), Vec3(0, 0, s)});
    ASSERT_NEAR(c.distance_m, std::abs(s) - 1.0, 2.0 * noiseOf(pair)) << s;
    if (std::abs(s) > 1e-13) {
      ASSERT_NEAR(c.n_W.z(), s > 0.0 ? 1.0 : -1.0, 1e-15) << s;
    }
  }
}

// An octahedron of circumradius 1 turning in its own place about z by t: faces of A are level with edges of B
// at multiples of a quarter turn; the depth is that of the full search all the way round.
TEST(EscapeDirection, OfSolidsTurningInOnePlace_GoesThroughEverySymmetricPoseContinuously) {
  Random random(7333);
  for (const ConvexPolyhedron& core :
       {oracle::octahedron(), oracle::dodecahedron(), boxPolyhedron({1, 1, 1})}) {
    const ConvexPart part{core, 0.0};
    PairMemory memory;
    double last = 0.0;
    const int steps = 7200 / kShare;
    const double angle = 2.0 * std::numbers::pi / steps;
    for (int i = 0; i <= steps; ++i) {
      const Pose X_WB{oracle::turned(Vec3::UnitZ(), i * angle), Vec3::Zero()};
      const double depth = -closestFeatures(part, Pose{}, part, X_WB, memory).distance_m;
      const PolyhedronPair pair(core, Pose{}, core, X_WB);
      ASSERT_NEAR(depth, -largestGap(pair).gap_m, 2.0 * noiseOf(pair)) << i;
      if (i > 0) {
        ASSERT_LE(std::abs(depth - last), angle * core.radiusAbout(Vec3::Zero()) + 4.0 * noiseOf(pair)) << i;
      }
      last = depth;
    }
  }
}

TEST(InnerPolytope, Forgotten_BeginsAgainWithTheSameAnswer) {
  Random random(7334);
  for (int i = 0; i < 100; ++i) {
    const OverlappingPair at = overlapping(Overlap::kDeep, 20, 20, random);
    const PolyhedronPair pair = at.pair();
    InnerPolytope polytope;
    const MinimumTranslation first = polytope.minimumTranslation(pair, noiseOf(pair));
    polytope.forget();
    EXPECT_EQ(polytope.triangleCount(), 0);
    const MinimumTranslation again = polytope.minimumTranslation(pair, noiseOf(pair));
    ASSERT_EQ(again.gap_m, first.gap_m) << i;
    ASSERT_EQ(again.features, first.features) << i;
  }
}

// The solid angle of a triangle seen from the origin, signed by its turn (van Oosterom and Strackee 1983).
oracle::Real solidAngle(const std::array<oracle::Vec3R, 3>& w) {
  const oracle::Real a = w[0].norm(), b = w[1].norm(), c = w[2].norm();
  return 2 * std::atan2(w[0].dot(w[1].cross(w[2])),
                        a * b * c + w[0].dot(w[1]) * c + w[1].dot(w[2]) * a + w[2].dot(w[0]) * b);
}

// The proof of a depth afresh: the triangles make a closed surface (each edge is run through once each way),
// it winds around the origin (the solid angles add up to 4 pi times a whole number, not zero), and no point
// of it is nearer than the depth: so the ball of that radius lies within the difference of the bodies.
TEST(TrackedSurface, IsClosedWindsAroundAndStaysOutsideTheDepth_AtEveryStepOfAWay) {
  for (const double step : {1e-4, 1e-2, 0.1}) {
    Random random(7335);
    OverlappingPair at = overlapping(Overlap::kDeep, 40, 40, random);
    InnerPolytope polytope;
    for (int i = 0; i < 600 / kShare; ++i) {
      at.X_WB.rotation = (oracle::turned(random.direction(), step) * at.X_WB.rotation).normalized();
      at.X_WB.position =
          at.X_WA.position + 0.97 * (at.X_WB.position - at.X_WA.position) + step * random.direction();
      const PolyhedronPair pair = at.pair();
      const double depth = -polytope.minimumTranslation(pair, noiseOf(pair)).gap_m;
      ASSERT_GT(depth, 0.0) << i;
      std::vector<std::pair<std::array<int, 2>, std::array<int, 2>>> forward, backward;
      oracle::Real angles = 0, nearest = 1e9;
      polytope.forEachTriangle([&](const auto& corners, const auto&) {
        std::array<oracle::Vec3R, 3> w;
        for (std::size_t k = 0; k < 3; ++k) {
          forward.emplace_back(corners[k], corners[(k + 1) % 3]);
          backward.emplace_back(corners[(k + 1) % 3], corners[k]);
          w[k] = (pair.a.vertex(corners[k][0]) - pair.toA(pair.b.vertex(corners[k][1])))
                     .template cast<oracle::Real>();
        }
        angles += solidAngle(w);
        nearest = std::min(nearest, oracle::pointTriangleSquared(oracle::Vec3R::Zero(), w[0], w[1], w[2]));
      });
      std::sort(forward.begin(), forward.end());
      std::sort(backward.begin(), backward.end());
      ASSERT_EQ(forward, backward) << i;
      ASSERT_EQ(static_cast<int>(forward.size()), 3 * polytope.triangleCount()) << i;
      const auto turns = static_cast<double>(angles) / (4.0 * std::numbers::pi);
      ASSERT_GE(std::round(turns), 1.0) << i;
      ASSERT_NEAR(turns, std::round(turns), 1e-9) << i;
      ASSERT_GE(static_cast<double>(std::sqrt(nearest)), depth - 2.0 * noiseOf(pair)) << i;
    }
  }
}

// One of the two has no faces: the polytope of the other is remembered as well.
TEST(TrackedDepth, OfABallsCentreInABox_IsFollowed) {
  const ConvexPart box{boxPolyhedron({2, 2, 2}), 0.0};
  const ConvexPart ball{ConvexPolyhedron::point(Vec3::Zero()), 0.25};
  PairMemory memory;
  for (int i = 0; i < 100; ++i) {
    const Pose X_WB{Quat::Identity(), Vec3(0.3 + 1e-3 * i, 0.2, 0.6)};
    const ClosestFeatures c = closestFeatures(box, Pose{}, ball, X_WB, memory);
    ASSERT_NEAR(c.distance_m, -0.4 - 0.25, 1e-14) << i;
    ASSERT_GE(memory.penetration.triangleCount(), 4) << i;
    if (i > 0) {
      ASSERT_EQ(c.states, 1) << i;
    }
  }
}

// A face of more corners than prove a facet by themselves: the polytope proves it, from the last one on.
TEST(TrackedDepth, OfAFaceOfManyCorners_IsFollowedByThePolytope) {
  const ConvexPart prism{oracle::prism(60, 1.0, 1.0), 0.0}, box{boxPolyhedron({1, 1, 1}), 0.0};
  Pose X_WB{oracle::turned(Vec3(1.0, 0.3, 0.2), 0.8), Vec3(0.1, 0.05, 0.0)};
  double lowest = 0.0;
  for (const Vec3& v : box.core.vertices()) lowest = std::min(lowest, (X_WB.rotation * v).z());
  X_WB.position.z() = 0.5 - lowest - 0.05;  // its lowest corner is 5 cm below the prism's top
  PairMemory memory;
  int followed = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    X_WB.position.x() += 1e-5;
    const ClosestFeatures c = closestFeatures(prism, Pose{}, box, X_WB, memory);
    ASSERT_NEAR(c.distance_m, -0.05, 1e-14) << i;
    followed += c.states == 1;
  }
  EXPECT_GE(followed, kSteps * 95 / 100);
}

}  // namespace
}  // namespace carom
