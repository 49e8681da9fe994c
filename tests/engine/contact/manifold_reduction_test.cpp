// Reduction against brute force over all quadruples of corners.

#include "engine/contact/manifold_reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <set>

#include "engine/contact/contact_id.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

constexpr double kSameGap = 1e-9;

// Four corners in order around a convex polygon: half the product of the diagonals.
double fourArea(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return 0.5 * (c - a).cross(d - b).norm();
}

double largestArea(const ContactPolygon& polygon, bool with_deepest) {
  const ArenaVector<PolygonCorner>& c = polygon.corners;
  double least = c[0].gap_m;
  for (const PolygonCorner& x : c) least = std::min(least, x.gap_m);
  const auto deepest = [&](std::size_t i) { return c[i].gap_m <= least + kSameGap; };
  double largest = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j)
      for (std::size_t k = j + 1; k < c.size(); ++k)
        for (std::size_t l = k + 1; l < c.size(); ++l)
          if (!with_deepest || deepest(i) || deepest(j) || deepest(k) || deepest(l))
            largest = std::max(largest, fourArea(c[i].p_W, c[j].p_W, c[k].p_W, c[l].p_W));
  return largest;
}

double keptArea(const ContactPolygon& polygon, const KeptCorners& kept) {
  const auto p = [&](std::size_t i) { return polygon.corners[static_cast<std::size_t>(kept.index[i])].p_W; };
  return kept.count < 4 ? 0.0 : fourArea(p(0), p(1), p(2), p(3));
}

bool keepsADeepest(const ContactPolygon& polygon, const KeptCorners& kept) {
  double least = polygon.corners[0].gap_m, least_kept = 1e9;
  for (const PolygonCorner& c : polygon.corners) least = std::min(least, c.gap_m);
  for (int i = 0; i < kept.count; ++i)
    least_kept = std::min(
        least_kept, polygon.corners[static_cast<std::size_t>(kept.index[static_cast<std::size_t>(i)])].gap_m);
  return least_kept <= least + kSameGap;
}

// The polygon of these plane corners placed at X_WF, gaps rising by `slope` from corner to corner.
ContactPolygon polygonOf(const std::vector<Vec2>& corners, const Pose& X_WF, const Vec2& slope) {
  ContactPolygon polygon;
  polygon.n_W = X_WF.rotation * Vec3::UnitZ();
  int v = 0;
  for (const Vec2& c : corners)
    polygon.corners.push_back(
        {X_WF * Vec3(c.x(), c.y(), 0), 1e-3 + slope.dot(c), {vertexFeature(v++), faceFeature(0)}});
  return polygon;
}

// n corners on a superellipse at random angles, sheared and squeezed.
std::vector<Vec2> randomConvex(Random& random, int n) {
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back(random.uniform(0, 2 * std::numbers::pi));
  std::sort(angles.begin(), angles.end());
  const double power = random.uniform(0.2, 1.0);  // 1: an ellipse; less: towards a rectangle
  const double squeeze = random.logUniform(1e-3, 1.0), shear = random.uniform(-2, 2);
  std::vector<Vec2> corners;
  for (const double a : angles) {
    const double x = std::copysign(std::pow(std::abs(std::cos(a)), power), std::cos(a));
    const double y = std::copysign(std::pow(std::abs(std::sin(a)), power), std::sin(a));
    corners.emplace_back(x + shear * y, squeeze * y);
  }
  return corners;
}

std::vector<Vec2> regular(int n) {
  std::vector<Vec2> corners;
  for (int i = 0; i < n; ++i)
    corners.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n));
  return corners;
}

TEST(ManifoldReduction, OfAFlatContact_Keeps95PercentOfTheLargestAreaOfAnyFour) {
  const std::uint64_t seed = 301;
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const ContactPolygon polygon =
        polygonOf(randomConvex(random, random.integer(5, 60)), random.pose(5), Vec2::Zero());
    const double largest = largestArea(polygon, false);
    const KeptCorners kept = reducePolygon(polygon, kSameGap);
    ASSERT_EQ(kept.count, 4);
    const double least_share = polygon.corners.size() <= 24 ? 1.0 - 1e-6 : 0.95;  // exact up to 24 corners
    ASSERT_GE(keptArea(polygon, kept), least_share * largest) << polygon.corners.size() << " corners";
  }
}

TEST(ManifoldReduction, OfATiltedContact_KeepsTheDeepestAnd95PercentOfTheLargestAreaWithIt) {
  const std::uint64_t seed = 302;
  Random random(seed);
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " case " << i);
    const Vec2 slope = random.logUniform(1e-9, 1e-2) * random.direction().head<2>();
    const ContactPolygon polygon =
        polygonOf(randomConvex(random, random.integer(5, 60)), random.pose(5), slope);
    const double largest = largestArea(polygon, true);
    const KeptCorners kept = reducePolygon(polygon, kSameGap);
    ASSERT_TRUE(keepsADeepest(polygon, kept));
    const double least_share = polygon.corners.size() <= 24 ? 1.0 - 1e-6 : 0.95;
    ASSERT_GE(keptArea(polygon, kept), least_share * largest) << polygon.corners.size() << " corners";
  }
}

TEST(ManifoldReduction, OfRegularPolygons_KeepsTheSquareInThem) {
  for (int n = 5; n <= 60; ++n) {
    const ContactPolygon polygon = polygonOf(regular(n), Pose{}, Vec2::Zero());
    const KeptCorners kept = reducePolygon(polygon, kSameGap);
    EXPECT_GE(keptArea(polygon, kept), 0.95 * largestArea(polygon, false)) << n;
  }
  for (const int n : {200, 400, 1000}) {
    const ContactPolygon polygon = polygonOf(regular(n), Pose{}, Vec2::Zero());
    EXPECT_GE(keptArea(polygon, reducePolygon(polygon, kSameGap)), 0.95 * 2.0) << n;
  }
}

// All are deepest: without thinning every diagonal would be looked at.
TEST(ManifoldReduction, OfTwentyThousandCorners_TakesNoTime) {
  constexpr double kMost_s = 1.0;  // of CPU time; hundreds of times what it takes
  const ContactPolygon polygon = polygonOf(regular(20000), Pose{}, Vec2::Zero());
  const std::clock_t begin = std::clock();
  KeptCorners kept;
  for (int i = 0; i < 3; ++i) kept = reducePolygon(polygon, kSameGap);
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kMost_s);
  EXPECT_GE(keptArea(polygon, kept), 0.95 * 2.0);
}

// An octagon whose odd corners are drawn in: of its two squares theirs has so much less area.
class FormerCornersOf : public testing::Test {
 protected:
  static ContactPolygon octagon(double area_share) {
    std::vector<Vec2> corners = regular(8);
    for (std::size_t i = 1; i < corners.size(); i += 2) corners[i] *= std::sqrt(area_share);
    return polygonOf(corners, Pose{}, Vec2::Zero());
  }
  static constexpr std::array<int, 4> kEven{0, 2, 4, 6}, kOdd{1, 3, 5, 7};
};

TEST_F(FormerCornersOf, ASquareStayWhileTheirAreaIsNearlyTheLargest) {
  EXPECT_EQ(reducePolygon(octagon(0.96), kSameGap).index, kEven);
  EXPECT_EQ(reducePolygon(octagon(0.96), kSameGap, {{4, kOdd}, kSameGap}).index, kOdd);
  EXPECT_EQ(reducePolygon(octagon(0.94), kSameGap, {{4, kOdd}, kSameGap}).index, kEven);
  EXPECT_EQ(reducePolygon(octagon(0.96), kSameGap, {{4, {0, 1, 4, 5}}, kSameGap}).index, kEven)
      << "a rectangle of 0.71 of the area";
}

TEST_F(FormerCornersOf, ASquareStayWhileADeepestIsAmongThem) {
  ContactPolygon polygon = octagon(0.96);
  polygon.corners[2].gap_m -= 2e-6;
  EXPECT_EQ(reducePolygon(polygon, kSameGap, {{4, kOdd}, 3e-6}).index, kOdd);
  EXPECT_EQ(reducePolygon(polygon, kSameGap, {{4, kOdd}, 1e-6}).index, kEven);
}

TEST_F(FormerCornersOf, ASquareThatHasLostOneAreChosenAnew) {
  EXPECT_EQ(reducePolygon(octagon(0.96), kSameGap, {{3, {1, 3, 5, 0}}, kSameGap}).index, kEven);
}

TEST_F(FormerCornersOf, ALongPolygonStayThoughThinningWouldDropThem) {
  const ContactPolygon polygon = polygonOf(regular(400), Pose{}, Vec2::Zero());
  const std::array<int, 4> former{33, 133, 233, 333};
  EXPECT_EQ(reducePolygon(polygon, kSameGap, {{4, former}, kSameGap}).index, former);
}

TEST(ManifoldReduction, OfUpToFourCorners_KeepsThemAll) {
  for (int n = 0; n <= 4; ++n) {
    ContactPolygon polygon = polygonOf(regular(4), Pose{}, Vec2(1e-4, 0));
    polygon.corners.resize(static_cast<std::size_t>(n));
    EXPECT_EQ(reducePolygon(polygon, kSameGap).count, n);
  }
}

TEST(ManifoldReduction, OfCornersInALine_KeepsTheDeepestAndTheEnds) {
  std::vector<Vec2> line;
  for (int i = 0; i < 7; ++i) line.emplace_back(i < 4 ? 2 * i : 13 - 2 * i, 0.0);
  ContactPolygon polygon = polygonOf(line, Pose{}, Vec2::Zero());  // there 0 2 4 6, back 5 3 1
  polygon.corners[2].gap_m = 0.5e-3;
  const KeptCorners kept = reducePolygon(polygon, kSameGap);
  const std::set<int> indices(kept.index.begin(), kept.index.begin() + kept.count);
  EXPECT_TRUE(indices.contains(0) && indices.contains(3) && indices.contains(2));
}

TEST(ManifoldReduction, ChoosesTheSameNamesAmongEqualAreasHoweverThePolygonLies) {
  const std::uint64_t seed = 303;
  Random random(seed);
  for (const int n : {5, 6, 8, 12, 16, 24, 25, 40, 60, 200}) {
    const auto names = [&](const ContactPolygon& polygon) {
      std::set<std::uint64_t> ids;
      const KeptCorners kept = reducePolygon(polygon, kSameGap);
      for (int i = 0; i < kept.count; ++i)
        ids.insert(
            symmetricKey(
                polygon.corners[static_cast<std::size_t>(kept.index[static_cast<std::size_t>(i)])].features)
                .first);
      return ids;
    };
    const std::set<std::uint64_t> first = names(polygonOf(regular(n), Pose{}, Vec2::Zero()));
    for (int i = 0; i < 20; ++i) {
      Pose X_WF = random.pose(5);
      X_WF.position *= i % 2 ? 1.0 : 2000.0;
      ContactPolygon polygon = polygonOf(regular(n), X_WF, Vec2::Zero());
      for (PolygonCorner& c : polygon.corners) c.p_W += 2e-10 * random.direction();
      std::rotate(polygon.corners.begin(), polygon.corners.begin() + random.integer(0, n - 1),
                  polygon.corners.end());
      if (i % 3 == 0) {  // seen from the other body
        std::reverse(polygon.corners.begin(), polygon.corners.end());
        polygon.n_W = -polygon.n_W;
      }
      EXPECT_EQ(names(polygon), first) << "seed " << seed << ", " << n << " corners, case " << i;
    }
  }
}

}  // namespace
}  // namespace carom
