// Hulls of point sets: what is merged, what is dropped, and what is refused with which reason.

#include "engine/solid/convex_hull.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "engine/foundation/contract.h"
#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

std::string refusal(const std::vector<Vec3>& points) {
  try {
    convexHull(points);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expectRefused(const std::vector<Vec3>& points, const std::string& reason) {
  const std::string said = refusal(points);
  EXPECT_NE(said.find(reason), std::string::npos) << "want " << reason << ", got: " << said;
}

// Every input point is inside, and every vertex is an input point: it is the hull.
void expectHullOf(const std::vector<Vec3>& points, const ConvexPolyhedron& hull, double tolerance_m) {
  for (int f = 0; f < hull.faceCount(); ++f)
    for (const Vec3& p : points) ASSERT_LE(hull.plane(f).signedDistance(p), tolerance_m);
  for (const Vec3& v : hull.vertices()) EXPECT_NE(std::find(points.begin(), points.end(), v), points.end());
}

TEST(ConvexHull, CoplanarGridOnABox_HasSixFaces) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      for (int k = 0; k <= 10; ++k) points.emplace_back(0.1 * i, 0.2 * j, 0.3 * k);
  const Hull hull = convexHull(points);
  EXPECT_EQ(hull.polyhedron.faceCount(), 6);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 8);
  EXPECT_EQ(hull.polyhedron.edgeCount(), 12);
  EXPECT_EQ(hull.report.points_given, 1331);
  EXPECT_EQ(hull.report.points_dropped, 1323);
  expectHullOf(points, hull.polyhedron, 1e-10);
}

TEST(ConvexHull, TurnedCoplanarGrid_HasSixFaces) {
  Random random(21);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose X = random.pose(3.0);
    std::vector<Vec3> points;
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; j <= 6; ++j)
        for (int k = 0; k <= 6; ++k)
          if (i % 6 == 0 || j % 6 == 0 || k % 6 == 0) points.push_back(X * Vec3(0.1 * i, 0.2 * j, 0.3 * k));
    const Hull hull = convexHull(points);
    EXPECT_EQ(hull.polyhedron.faceCount(), 6) << "trial " << trial;
    EXPECT_EQ(hull.polyhedron.vertexCount(), 8) << "trial " << trial;
  }
}

TEST(ConvexHull, ThousandPointsOnASphere_AreAllVertices) {
  Random random(22);
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back(random.direction());
  const Hull hull = convexHull(points);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 1000);
  EXPECT_EQ(hull.polyhedron.faceCount(), 1996) << "a triangulated sphere has 2n - 4 faces";
  EXPECT_EQ(hull.report.points_dropped, 0);
  expectHullOf(points, hull.polyhedron, 1e-10);
}

TEST(ConvexHull, DuplicateAndInteriorPoints_AreDroppedAndCounted) {
  std::vector<Vec3> points = boxPolyhedron(Vec3::Ones()).vertices();
  const std::vector<Vec3> corners = points;
  points.insert(points.end(), corners.begin(), corners.end());
  points.emplace_back(0.1, 0.2, -0.3);
  const Hull hull = convexHull(points);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 8);
  EXPECT_EQ(hull.report.points_given, 17);
  EXPECT_EQ(hull.report.points_dropped, 9);
  EXPECT_EQ(hull.report.facets_merged, 6);
}

TEST(ConvexHull, RegularSolids_KeepTheirFaces) {
  const ConvexPolyhedron d = oracle::dodecahedron();
  EXPECT_EQ(d.faceCount(), 12);
  for (int f = 0; f < 12; ++f) EXPECT_EQ(d.faceVertices(f).size(), 5u);
  EXPECT_EQ(oracle::icosahedron().faceCount(), 20);
}

TEST(ConvexHull, PrismOverA200Gon_HasTwoLargeFaces) {
  const Hull hull = convexHull(oracle::prism(200, 1.0, 0.5).vertices());
  EXPECT_EQ(hull.polyhedron.faceCount(), 202);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 400);
  int large = 0;
  for (int f = 0; f < hull.polyhedron.faceCount(); ++f)
    large += hull.polyhedron.faceVertices(f).size() == 200;
  EXPECT_EQ(large, 2);
}

TEST(ConvexHull, SpikeOverA200Gon_HasAVertexOfDegree200) {
  std::vector<Vec3> points = oracle::prism(200, 1.0, 0.5).vertices();
  points.resize(200);
  points.emplace_back(0, 0, 1);
  const ConvexPolyhedron spike = convexHull(points).polyhedron;
  std::size_t most = 0;
  for (int v = 0; v < spike.vertexCount(); ++v) most = std::max(most, spike.vertexEdges(v).size());
  EXPECT_EQ(most, 200u);
}

TEST(ConvexHull, SmallLargeAndFarAway_IsTheSameShape) {
  for (double size : {1e-3, 1.0, 100.0})
    for (double away : {0.0, 1e4}) {
      std::vector<Vec3> points;
      for (const Vec3& v : oracle::dodecahedronPoints())
        points.push_back(size * v + Vec3(away, -away, 0.5 * away) * size);
      EXPECT_EQ(convexHull(points).polyhedron.vertexCount(), 20) << size << " at " << away;
      if (away > 0.0) continue;  // rounded coordinates are not coplanar any more
      EXPECT_EQ(convexHull(points).polyhedron.faceCount(), 12) << size;
    }
}

TEST(ConvexHull, TooFewPoints_AreRefused) {
  expectRefused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "at least 4 points");
  expectRefused({}, "at least 4 points");
}

TEST(ConvexHull, NonFinitePoints_AreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (double bad : {nan, infinity, -infinity}) {
    std::vector<Vec3> points = boxPolyhedron(Vec3::Ones()).vertices();
    points[3].y() = bad;
    expectRefused(points, "not finite");
  }
}

TEST(ConvexHull, CoincidentPoints_AreRefused) {
  expectRefused(std::vector<Vec3>(9, Vec3(1, 2, 3)), "coincide");
}

TEST(ConvexHull, CollinearPoints_AreRefused) {
  std::vector<Vec3> points;
  for (int i = 0; i < 9; ++i) points.push_back(Vec3(1, 2, 3) + i * Vec3(0.3, -0.1, 0.7));
  expectRefused(points, "one line");
}

TEST(ConvexHull, CoplanarPoints_AreRefused) {
  Random random(23);
  const Pose X = random.pose(2.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) points.push_back(X * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0));
  expectRefused(points, "one plane");
}

TEST(ConvexHull, ThinButSolidPlate_IsAccepted) {
  std::vector<Vec3> points = boxPolyhedron({1, 1, 1e-5}).vertices();
  EXPECT_EQ(convexHull(points).polyhedron.faceCount(), 6);
}

TEST(ConvexHull, OfItsOwnVertices_IsItself) {
  Random random(24);
  for (int trial = 0; trial < 50; ++trial) {
    const ConvexPolyhedron once = oracle::randomHull(random, random.integer(4, 100), Vec3(1, 0.5, 0.05));
    const Hull twice = convexHull(once.vertices());
    EXPECT_EQ(twice.polyhedron.vertexCount(), once.vertexCount());
    EXPECT_EQ(twice.polyhedron.faceCount(), once.faceCount());
    EXPECT_EQ(twice.report.points_dropped, 0);
  }
}

}  // namespace
}  // namespace carom
