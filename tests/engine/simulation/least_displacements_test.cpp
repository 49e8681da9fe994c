// The least displacements that open gaps: closed forms of lines, the conditions that make a minimum of any
// other, and what is made of openings that contradict each other.

#include "engine/simulation/least_displacements.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <numbers>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

double openedBy(const Opening& o, const std::vector<Vec3>& d) {
  const auto moved = [&](int body) {
    return body < 0 ? Vec3(Vec3::Zero()) : d[static_cast<std::size_t>(body)];
  };
  return o.n_W.dot(moved(o.b) - moved(o.a));
}

std::vector<Vec3> allFree(int bodies) {
  return std::vector<Vec3>(static_cast<std::size_t>(bodies), Vec3::Ones());
}

TEST(LeastDisplacements, TwoBodiesGiveWayByHalf) {
  const Vec3 n = Vec3(1, 2, 2) / 3.0;
  const LeastDisplacements least = leastDisplacements(std::vector<Opening>{{0, 1, n, 0.3}}, allFree(3));
  EXPECT_LT((least.displacement_W[0] + 0.15 * n).norm(), 1e-7);
  EXPECT_LT((least.displacement_W[1] - 0.15 * n).norm(), 1e-7);
  EXPECT_EQ(least.displacement_W[2], Vec3::Zero());
}

TEST(LeastDisplacements, ATowerOnWhatDoesNotGiveWay_IsLifted) {
  std::vector<Opening> openings;
  for (int i = 0; i < 50; ++i) openings.push_back({i - 1, i, Vec3::UnitZ(), 1.0});
  const LeastDisplacements least = leastDisplacements(openings, allFree(50));
  EXPECT_LE(least.products, 2 * 50) << "conjugate gradients end after 50 of them, but for rounding";
  for (int i = 0; i < 50; ++i) {
    // Forces add up downwards to less than 50 * 51 / 2 openings each; the rows give way by 1e-7 of them.
    EXPECT_NEAR(least.displacement_W[static_cast<std::size_t>(i)].z(), i + 1, 50 * 50 * 51 * 1e-7);
  }
}

TEST(LeastDisplacements, OfRandomOpenings_MeetTheConditionsOfTheMinimum) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    oracle::Random random(seed);
    const int bodies = 30;
    std::vector<Vec3> places;
    for (int i = 0; i < bodies; ++i) places.push_back(3.0 * random.uniform(0.2, 1.0) * random.direction());
    std::vector<Opening> openings;
    for (int i = 0; i < bodies; ++i)
      for (int j = i + 1; j < bodies; ++j) {
        const Vec3 between = places[static_cast<std::size_t>(j)] - places[static_cast<std::size_t>(i)];
        openings.push_back({i, j, between.normalized(), 1.0 - between.norm()});
      }
    const LeastDisplacements least = leastDisplacements(openings, allFree(bodies));
    double length = 0.0, share = 0.0;
    for (const Vec3& d : least.displacement_W) length += d.squaredNorm();
    for (const Opening& o : openings) {
      EXPECT_GE(openedBy(o, least.displacement_W), o.opening_m - 1e-5);
      share = std::max(share, o.opening_m / (1.0 - o.opening_m));
    }
    // Of all that open enough it is the nearest to nothing: seen from there none lies backwards (projection
    // on a convex set). Others: all bodies moved away from a point by this share of their distance, and more,
    // each pair by as much as it wants.
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 from = 3.0 * random.direction();
      const double more = share * random.uniform(1.0, 2.0);
      double forwards = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i)
        forwards += least.displacement_W[i].dot(more * (places[i] - from) - least.displacement_W[i]);
      EXPECT_GE(forwards, -1e-4 * length);
    }
    // Nor does it move more than those that want it: what pushes a body away is a pair that opens no further.
    for (int i = 0; i < bodies; ++i) {
      if (least.displacement_W[static_cast<std::size_t>(i)].isZero(0.0)) continue;
      bool pushed = false;
      for (const Opening& o : openings)
        pushed = pushed || ((o.a == i || o.b == i) && openedBy(o, least.displacement_W) < o.opening_m + 1e-9);
      EXPECT_TRUE(pushed) << i;
    }
  }
}

TEST(LeastDisplacements, AreNoneWhereNothingIsToOpen) {
  const LeastDisplacements least = leastDisplacements(
      std::vector<Opening>{{0, 1, Vec3::UnitX(), -0.1}, {1, 2, Vec3::UnitX(), 0.0}}, allFree(3));
  for (const Vec3& d : least.displacement_W) EXPECT_EQ(d, Vec3::Zero());
  EXPECT_EQ(least.products, 0);
}

// The first may not be moved along x, the second only along x.
TEST(LeastDisplacements, AreAlongFreeAxesOnly) {
  const Vec3 n = Vec3(3, 4, 0) / 5.0;
  const std::vector<Opening> opening{{0, 1, n, 0.5}};
  const LeastDisplacements least =
      leastDisplacements(opening, std::vector<Vec3>{Vec3(0, 1, 1), Vec3(1, 0, 0)});
  // One force f pushes both along what is free of n: f (0.8^2 + 0.6^2) = 0.5.
  EXPECT_EQ(least.displacement_W[0].x(), 0.0);
  EXPECT_NEAR(least.displacement_W[0].y(), -0.4, 1e-6);
  EXPECT_NEAR(least.displacement_W[1].x(), 0.3, 1e-6);
  EXPECT_EQ(least.displacement_W[1].y(), 0.0);
  EXPECT_LT(std::abs(least.missing_m[0]), 1e-6);
}

TEST(LeastDisplacements, WhereNoFreeAxisOpens_AllOfItIsMissing) {
  const std::vector<Opening> opening{{-1, 0, Vec3::UnitZ(), 0.5}};
  const LeastDisplacements least = leastDisplacements(opening, std::vector<Vec3>{Vec3(1, 1, 0)});
  EXPECT_EQ(least.displacement_W[0], Vec3::Zero());
  EXPECT_NEAR(least.missing_m[0], 0.5, 1e-9);
}

TEST(LeastDisplacements, OpeningsThatContradictEachOther_MissInEqualParts) {
  const std::vector<Opening> slot{
      {-1, 0, Vec3::UnitX(), 1.0}, {0, 1, Vec3::UnitX(), 1.0}, {1, -1, Vec3::UnitX(), 0.5}};
  const LeastDisplacements least = leastDisplacements(slot, allFree(2));
  for (const double missing : least.missing_m) EXPECT_NEAR(missing, 2.5 / 3.0, 1e-5);
  EXPECT_NEAR(least.displacement_W[0].x(), 1.0 - 2.5 / 3.0, 1e-5);
}

// Body 0 alone among many that do not give way. Those around a cone about z ask for just as much as 0.3 m up
// is along them, all others for less: their forces add up to a way up, so that is the least.
TEST(LeastDisplacements, OneBodyAmongManyThatDoNotGiveWay_MovesOutBetweenThem) {
  oracle::Random random(21);
  std::vector<Opening> openings;
  for (int i = 0; i < 40; ++i) {
    const double around = 2.0 * std::numbers::pi * i / 40.0;
    const Vec3 n(std::sin(0.8) * std::cos(around), std::sin(0.8) * std::sin(around), std::cos(0.8));
    openings.push_back({-1, 0, n, 0.3 * n.z()});
    const Vec3 other = random.direction();
    openings.push_back({-1, 0, other, 0.3 * other.z() - random.uniform(0.01, 0.2)});
  }
  const LeastDisplacements least = leastDisplacements(openings, allFree(1));
  EXPECT_LT((least.displacement_W[0] - Vec3(0, 0, 0.3)).norm(), 1e-6);
  EXPECT_LT(least.products, 500);
}

// Around a cone each plane asks for a little less than a displacement up the axis gives it. Most of them let
// go; one after the other that would take three products each.
TEST(LeastDisplacements, AmongPlanesMostOfWhichLetGo_TakeFewerThanTwoProductsEach) {
  constexpr int kPlanes = 1000;
  oracle::Random random(21);
  std::vector<Opening> openings;
  for (int i = 0; i < kPlanes; ++i) {
    const double around = 2.0 * std::numbers::pi * i / kPlanes;
    const Vec3 n(std::sin(0.8) * std::cos(around), std::sin(0.8) * std::sin(around), std::cos(0.8));
    openings.push_back({-1, 0, n, 0.3 * n.z() - random.uniform(0.0, 0.01)});
  }
  const LeastDisplacements least = leastDisplacements(openings, allFree(1));
  EXPECT_LT(least.products, 2 * kPlanes);
  int pressing = 0;
  for (const Opening& o : openings) {
    const double opened = openedBy(o, least.displacement_W);
    EXPECT_GE(opened, o.opening_m - 1e-6);
    pressing += opened < o.opening_m + 1e-6;
  }
  EXPECT_LT(pressing, kPlanes / 10);
}

}  // namespace
}  // namespace carom
