// The table of directions: where it starts a climb, the climb ends at the true support vertex, after few
// steps whatever the number of vertices. Seeds 7200 to 7208.

#include "engine/solid/support_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "tests/oracle/test_shapes.h"
#include "tests/support/build_effort.h"

namespace carom {
namespace {

using oracle::Random;

constexpr int kDirections = inThisBuild(100000, 2000);

SupportTable tableOf(const ConvexPolyhedron& p) {
  return {p.vertexCount(), [&](const Vec3& d, int start) { return p.support(d, start); }};
}

// The height of the true support vertex.
double highest(const ConvexPolyhedron& p, const Vec3& direction) {
  double most = -1e300;
  for (const Vec3& v : p.vertices()) most = std::max(most, direction.dot(v));
  return most;
}

// Steepest climb over the edges until no neighbour is higher: the steps it takes.
int climbSteps(const ConvexPolyhedron& p, const Vec3& direction, int start) {
  int steps = 0;
  for (int here = start;; ++steps) {
    int next = -1;
    double steepest = 1e-15;
    for (const Spoke& spoke : p.spokes(here))
      if (const double slope = spoke.direction.dot(direction); slope > steepest) {
        steepest = slope;
        next = spoke.head;
      }
    if (next < 0) return steps;
    here = next;
  }
}

struct Climbs {
  double mean = 0.0;
  int most = 0;
};

Climbs climbsFromTable(const ConvexPolyhedron& p, std::uint64_t seed, int directions) {
  const SupportTable table = tableOf(p);
  Random random(seed);
  Climbs climbs;
  for (int i = 0; i < directions; ++i) {
    const Vec3 d = random.direction();
    const int steps = climbSteps(p, d, table.vertexNear(d));
    climbs.mean += static_cast<double>(steps) / directions;
    climbs.most = std::max(climbs.most, steps);
  }
  return climbs;
}

// The unit box with each face an n by n grid of squares that were not merged: coplanar faces, flat edges and
// vertices that stick out of nothing.
ConvexPolyhedron unmergedGrid(int n) {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> loops;
  const auto vertexAt = [&](const std::array<int, 3>& k) {
    const Vec3 p(k[0], k[1], k[2]);
    const auto known = std::find(vertices.begin(), vertices.end(), p);
    if (known != vertices.end()) return static_cast<int>(known - vertices.begin());
    vertices.push_back(p);
    return static_cast<int>(vertices.size()) - 1;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool top : {false, true})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> k{};
            k[axis] = top ? n : 0;
            k[(axis + 1) % 3] = i + di;
            k[(axis + 2) % 3] = j + dj;
            return vertexAt(k);
          };
          std::vector<int> loop{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (!top) std::reverse(loop.begin(), loop.end());
          loops.push_back(loop);
        }
  for (Vec3& v : vertices) v = v / n - Vec3::Constant(0.5);
  return ConvexPolyhedron::fromFaces(std::move(vertices), loops);
}

std::vector<std::pair<std::string, ConvexPolyhedron>> population() {
  Random random(7200);
  std::vector<std::pair<std::string, ConvexPolyhedron>> all;
  for (const int n : {20, 62, 252, 1000})
    all.emplace_back("sphere of " + std::to_string(n), oracle::randomHull(random, n));
  all.emplace_back("1000-gon prism", oracle::prism(1000, 1.0, 0.5));
  all.emplace_back("sliver", oracle::randomHull(random, 200, Vec3(1, 1e-2, 1e-2)));
  all.emplace_back("flat sliver", oracle::randomHull(random, 200, Vec3(1, 1e-1, 1e-3)));
  all.emplace_back("box", boxPolyhedron({1, 2, 3}));
  all.emplace_back("unmerged grid", unmergedGrid(8));
  return all;
}

// A climb may stop where all edges climb by less than the rounding of a product of unit vectors, 1e-15: it
// then is at most 1e-15 times the way to the top below it, a diameter and as much again for the sums.
TEST(SupportTable, ClimbFromItsVertex_EndsAtTheFarthestVertex) {
  for (const auto& [name, p] : population()) {
    const SupportTable table = tableOf(p);
    Random random(7201);
    for (int i = 0; i < kDirections; ++i) {
      const Vec3 d = random.direction();
      const int v = p.support(d, table.vertexNear(d));
      ASSERT_NEAR(d.dot(p.vertex(v)), highest(p, d), 4e-15 * p.radius()) << name << ", direction " << i;
    }
  }
}

// The table's cells grow with the vertices, so on a ball the start is as near whatever their number: from a
// fixed vertex the way to the top is as long as the root of their number.
TEST(SupportTable, ClimbOverABall_DoesNotGrowWithTheNumberOfVertices) {
  for (const int n : {20, 62, 252, 1000}) {
    Random random(7202);
    const Climbs climbs = climbsFromTable(oracle::randomHull(random, n), 7203, kDirections);
    EXPECT_LT(climbs.mean, 0.5) << n;
    EXPECT_LE(climbs.most, 6) << n;
  }
}

// Slivers have their vertices in few cells, but few directions point there.
TEST(SupportTable, ClimbOverASliver_IsOneStepInTheMean) {
  for (const Vec3& axes : {Vec3(1, 1e-2, 1e-2), Vec3(1, 1e-1, 1e-3)})
    for (const int n : {100, 300, 1000}) {
      Random random(7202);
      const Climbs climbs = climbsFromTable(oracle::randomHull(random, n, axes), 7203, kDirections);
      EXPECT_LT(climbs.mean, 1.0) << n;
      EXPECT_LT(climbs.most, 40) << n;
    }
}

TEST(SupportTable, ClimbOverAnUnmergedGrid_IsOneStepInTheMean) {
  for (const int n : {2, 3, 4, 5, 8, 12}) {
    const Climbs climbs = climbsFromTable(unmergedGrid(n), 7203, kDirections);
    EXPECT_LT(climbs.mean, 1.0) << n;
  }
}

// All 2n vertices of a prism lie along two rims, and the cells over a rim grow with the root of n only: so
// does the mean climb. It must stay a small part of the way around.
TEST(SupportTable, ClimbOverAPrism_GrowsWithTheRootOfItsSidesAtMost) {
  for (const int n : {100, 300, 1000}) {
    const Climbs climbs = climbsFromTable(oracle::prism(n, 1.0, 0.5), 7203, kDirections);
    EXPECT_LT(climbs.mean, 0.15 * std::sqrt(n)) << n;
    EXPECT_LE(climbs.most, n / 2 + 1) << n;
  }
}

// On the borders between the cube map's sides and cells any neighbour's cell serves.
TEST(SupportTable, AlongTheAxes_LeadsToAFarthestVertex) {
  Random random(7204);
  for (const int n : {13, 48, 300}) {
    const ConvexPolyhedron p = oracle::randomHull(random, n);
    const SupportTable table = tableOf(p);
    for (int axis = 0; axis < 3; ++axis)
      for (const double length : {-1e6, -1.0, 1e-6, 1.0}) {
        const Vec3 d = length * Vec3::Unit(axis);
        const int v = p.support(d, table.vertexNear(d));
        EXPECT_NEAR(d.dot(p.vertex(v)), highest(p, d), 1e-14 * std::abs(length)) << n;
      }
  }
}

TEST(SupportTable, DoesNotDependOnTheLengthOfTheDirection) {
  Random random(7205);
  const ConvexPolyhedron p = oracle::randomHull(random, 252);
  const SupportTable table = tableOf(p);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 d = random.direction();
    const int near = table.vertexNear(d);
    for (const double scale : {0x1p-60, 0x1p-3, 0x1p20, 0x1p100})
      ASSERT_EQ(table.vertexNear(scale * d), near) << i;
  }
}

// Over the smallest component of such a direction a length in cells would be infinite.
TEST(SupportTable, OfDenormalAndHugeDirections_IsThatOfDirectionsOfAnyLength) {
  Random random(7207);
  const ConvexPolyhedron p = oracle::randomHull(random, 252);
  const SupportTable table = tableOf(p);
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        const Vec3 d(x, y, z);
        if (d.isZero()) continue;
        const int near = table.vertexNear(d);
        ASSERT_EQ(table.vertexNear(Vec3(x * 0x1p-1074, y * 0x1p-1074, z * 0x1p-1074)), near) << d.transpose();
        ASSERT_EQ(table.vertexNear(Vec3(x * 0x1p1022, y * 0x1p1022, z * 0x1p1022)), near) << d.transpose();
      }
}

TEST(SupportTable, OfZeroAndOfWhatIsNoNumber_IsSomeVertex) {
  Random random(7208);
  const ConvexPolyhedron p = oracle::randomHull(random, 252);
  const SupportTable table = tableOf(p);
  const double infinity = std::numeric_limits<double>::infinity();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {0.0, -0.0, infinity, -infinity, none})
    for (const double y : {0.0, 1.0, infinity, none})
      for (const double z : {0.0, -1.0, -infinity, none}) {
        const int near = table.vertexNear({x, y, z});
        ASSERT_GE(near, 0);
        ASSERT_LT(near, p.vertexCount());
      }
}

TEST(SupportTable, OfFewVertices_IsNoneAndNamesTheFirst) {
  const ConvexPolyhedron box = boxPolyhedron({1, 2, 3});
  const SupportTable table = tableOf(box);
  Random random(7206);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(table.vertexNear(random.direction()), 0);
}

}  // namespace
}  // namespace carom
