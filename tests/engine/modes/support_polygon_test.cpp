// The support polygon against brute force: membership by triangles, distance by sampling the rim.

#include "engine/modes/support_polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// By Caratheodory a point is in the cover of a set exactly when it is in a triangle of three of its points.
bool inSomeTriangle(const std::vector<Vec2>& points, const Vec2& p) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const double a = cross(points[j] - points[i], p - points[i]),
                     b = cross(points[k] - points[j], p - points[j]),
                     c = cross(points[i] - points[k], p - points[k]);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return true;
      }
  return false;
}

std::vector<Vec2> randomPoints(Random& random, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1));
  return points;
}

TEST(ConvexCover, IsConvexCounterClockwiseAndHoldsEveryPoint) {
  Random random(121);
  for (int i = 0; i < 500; ++i) {
    const std::vector<Vec2> points = randomPoints(random, random.integer(3, 20));
    const std::vector<Vec2> cover = convexCover(points);
    ASSERT_GE(cover.size(), 3u);
    for (std::size_t k = 0; k < cover.size(); ++k) {
      const Vec2 &a = cover[k], &b = cover[(k + 1) % cover.size()], &c = cover[(k + 2) % cover.size()];
      ASSERT_GT(cross(b - a, c - b), 0.0) << i;
      for (const Vec2& p : points) ASSERT_GE(cross(b - a, p - a), -1e-15) << i;
      ASSERT_NE(std::find(points.begin(), points.end(), a), points.end()) << "a corner is one of the points";
    }
  }
}

TEST(ConvexCover, OfALatticeHasItsFourCornersOnly) {
  std::vector<Vec2> points;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y) points.emplace_back(0.1 * x, 0.1 * y);
  EXPECT_EQ(convexCover(points).size(), 4u);
}

TEST(ConvexCover, OfLessThanAnAreaIsAPointOrAStretch) {
  EXPECT_TRUE(convexCover({}).empty());
  EXPECT_EQ(convexCover({Vec2(1, 2), Vec2(1, 2), Vec2(1, 2)}).size(), 1u);
  EXPECT_EQ(convexCover({Vec2(1, 2), Vec2(2, 3), Vec2(0, 1), Vec2(5, 6)}).size(), 2u);
}

TEST(DistanceOutside, IsZeroExactlyInTheCover) {
  Random random(122);
  int in = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Vec2> points = randomPoints(random, random.integer(3, 8));
    const Vec2 p(random.uniform(-1, 1), random.uniform(-1, 1));
    const double d = distanceOutside(convexCover(points), p);
    ASSERT_EQ(d == 0.0, inSomeTriangle(points, p)) << i << " distance " << d;
    in += d == 0.0;
  }
  EXPECT_GT(in, 500);
}

TEST(DistanceOutside, IsTheDistanceToTheNearestOfManyPointsOfTheCover) {
  Random random(123);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vec2> cover = convexCover(randomPoints(random, random.integer(1, 6)));
    const Vec2 p(random.uniform(-3, 3), random.uniform(-3, 3));
    const double d = distanceOutside(cover, p);
    if (d == 0.0) continue;
    double nearest = 1e9;
    const int looks = 2000;
    for (std::size_t k = 0; k < cover.size(); ++k)
      for (int s = 0; s <= looks; ++s) {
        const Vec2 q = cover[k] + (cover[(k + 1) % cover.size()] - cover[k]) * s / looks;
        nearest = std::min(nearest, (p - q).norm());
      }
    EXPECT_LE(d, nearest + 1e-12) << i;
    EXPECT_GE(d, nearest - 3.0 / looks) << i;
  }
}

// A box of half width 0.5 about the origin on its four corners.
std::vector<BodyContact> fourFeet(const Quat& R, const Vec3& shift = Vec3::Zero()) {
  std::vector<BodyContact> feet;
  for (double x : {-0.5, 0.5})
    for (double y : {-0.5, 0.5})
      feet.push_back({R * (Vec3(x, y, -0.5) + shift), R * Vec3::UnitZ(), Vec3::Zero()});
  return feet;
}

TEST(SupportMiss, IsHowFarTheWeightFallsBesideTheFeet) {
  Random random(124);
  const Quat R = random.rotation();
  const Vec3 weight = R * Vec3(0, 0, -20);
  EXPECT_EQ(supportMiss(Vec3::Zero(), weight, fourFeet(R)), 0.0);
  EXPECT_EQ(supportMiss(R * Vec3(0.49, -0.49, 3), weight, fourFeet(R)), 0.0);
  EXPECT_NEAR(supportMiss(R * Vec3(0.75, 0.1, 3), weight, fourFeet(R)), 0.25, 1e-14);
  EXPECT_NEAR(supportMiss(R * Vec3(0.8, 0.9, -2), weight, fourFeet(R)), 0.5, 1e-14);
}

TEST(SupportMiss, OnASlopeFollowsTheWeightNotTheNormal) {
  const Quat tilt = oracle::turned(Vec3::UnitY(), std::atan(0.9));
  EXPECT_EQ(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), fourFeet(tilt)), 0.0) << "tan 0.9 < b / h = 1";
  const Quat steep = oracle::turned(Vec3::UnitY(), std::atan(1.1));
  const double miss = supportMiss(Vec3::Zero(), Vec3(0, 0, -20), fourFeet(steep));
  EXPECT_NEAR(miss, (0.5 * 1.1 - 0.5) * std::cos(std::atan(1.1)), 1e-12);
}

// Fig. 10: a load on the overhang shifts the effective force by its moment over the whole weight.
TEST(SupportMiss, CountsWhatPressesFromAbove) {
  std::vector<BodyContact> contacts = fourFeet(Quat::Identity());
  contacts.push_back({Vec3(1.0, 0, 0.5), Vec3(0, 0, -1), Vec3(0, 0, -10)});
  EXPECT_EQ(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), contacts), 0.0) << "10 / 30 of 1 m is within 0.5 m";
  contacts.back().force_N = Vec3(0, 0, -60);
  EXPECT_NEAR(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), contacts), 60.0 / 80.0 - 0.5, 1e-12);
}

TEST(SupportMiss, MovesTowardsTheLoadNotAwayFromIt) {
  std::vector<BodyContact> contacts = fourFeet(Quat::Identity());
  contacts.push_back({Vec3(1.0, 0.2, 0.5), Vec3(0, 0, -1), Vec3(0, 0, -60)});
  // Weighted means of where 20 N and 60 N act: x = 0.825, y = 0.125.
  EXPECT_NEAR(supportMiss(Vec3(0.3, -0.1, 0.2), Vec3(0, 0, -20), contacts), 0.325, 1e-12);
}

TEST(SupportMiss, OfABodyThatNothingHoldsUpIsInfinite) {
  EXPECT_TRUE(std::isinf(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), {})));
  const std::vector<BodyContact> wall{{Vec3(-0.5, 0, 0), Vec3(1, 0, 0), Vec3(5, 0, 0)}};
  EXPECT_TRUE(std::isinf(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), wall)));
  const std::vector<BodyContact> ceiling{{Vec3(0, 0, 0.5), Vec3(0, 0, -1), Vec3(0, 0, -5)}};
  EXPECT_TRUE(std::isinf(supportMiss(Vec3::Zero(), Vec3(0, 0, -20), ceiling)));
}

}  // namespace
}  // namespace carom
