// Hulls of point sets: what is merged, what is dropped, and what is refused with which reason.

#include "engine/solid/convex_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "engine/foundation/contract.h"
#include "tests/oracle/test_shapes.h"
#include "tests/support/thrown_message.h"

namespace carom {
namespace {

using oracle::Random;

void expectRefused(const std::vector<Vec3>& points, const std::string& reason) {
  const std::string said = thrownMessage<InputError>([&points] { convexHull(points); });
  EXPECT_NE(said.find(reason), std::string::npos) << "want " << reason << ", got: " << said;
}

// Every input point is inside, and every vertex is an input point: it is the hull.
void expectHullOf(const std::vector<Vec3>& points, const ConvexPolyhedron& hull, double tolerance_m) {
  for (int f = 0; f < hull.faceCount(); ++f)
    for (const Vec3& p : points) ASSERT_LE(hull.plane(f).signedDistance(p), tolerance_m);
  for (const Vec3& v : hull.vertices()) EXPECT_NE(std::find(points.begin(), points.end(), v), points.end());
}

using Vec3R = Eigen::Matrix<long double, 3, 1>;

// Newell's normal in long double, about the face's first corner.
Vec3R normalOf(const ConvexPolyhedron& hull, int f) {
  const std::span<const int> loop = hull.faceVertices(f);
  const Vec3R base = hull.vertex(loop[0]).cast<long double>();
  Vec3R area = Vec3R::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    area += (hull.vertex(loop[i]).cast<long double>() - base)
                .cross(hull.vertex(loop[i + 1]).cast<long double>() - base);
  return area.normalized();
}

// A closed surface that is convex at every edge and planar in every face is convex as a whole.
void expectConvex(const ConvexPolyhedron& hull, double tolerance_m) {
  EXPECT_EQ(hull.vertexCount() - hull.edgeCount() + hull.faceCount(), 2) << "Euler";
  for (int f = 0; f < hull.faceCount(); ++f) {
    const Vec3R normal = normalOf(hull, f);
    const Vec3R base = hull.vertex(hull.faceVertices(f)[0]).cast<long double>();
    const auto height = [&](int v) { return normal.dot(hull.vertex(v).cast<long double>() - base); };
    for (int v : hull.faceVertices(f)) ASSERT_LE(std::abs(height(v)), tolerance_m) << "face " << f;
    for (int e : hull.faceEdges(f))
      for (int v : hull.faceVertices(hull.faceAcross(e, f)))
        ASSERT_LE(height(v), tolerance_m) << "face " << f;
  }
}

double farthestOutside(const std::vector<Vec3>& points, const ConvexPolyhedron& hull) {
  double farthest = 0.0;
  for (int f = 0; f < hull.faceCount(); ++f)
    for (const Vec3& p : points) farthest = std::max(farthest, hull.plane(f).signedDistance(p));
  return farthest;
}

int largestFace(const ConvexPolyhedron& hull) {
  std::size_t most = 0;
  for (int f = 0; f < hull.faceCount(); ++f) most = std::max(most, hull.faceVertices(f).size());
  return static_cast<int>(most);
}

int largestDegree(const ConvexPolyhedron& hull) {
  std::size_t most = 0;
  for (int v = 0; v < hull.vertexCount(); ++v) most = std::max(most, hull.spokes(v).size());
  return static_cast<int>(most);
}

std::vector<Vec3> moved(std::vector<Vec3> points, const Pose& X) {
  for (Vec3& p : points) p = X * p;
  return points;
}

// What a file in single precision makes of the points, and what it says about their accuracy.
std::vector<Vec3> inSinglePrecision(std::vector<Vec3> points) {
  for (Vec3& p : points) p = p.cast<float>().cast<double>();
  return points;
}
HullSettings singlePrecision(const std::vector<Vec3>& points) {
  double reach = 0.0;
  for (const Vec3& p : points) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  return {.coordinate_error_m = 0x1p-24 * reach};
}

std::vector<Vec3> cuboctahedronPoints() {
  std::vector<Vec3> points;
  for (double a : {-1.0, 1.0})
    for (double b : {-1.0, 1.0}) points.insert(points.end(), {{a, b, 0}, {a, 0, b}, {0, a, b}});
  return points;
}

// The vertices of the polar dual of the rhombicuboctahedron: 24 kites, four of them around six vertices.
std::vector<Vec3> deltoidalPoints() {
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 8; ++i) {
      Vec3 p(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      p[axis] *= 1.0 + std::numbers::sqrt2;
      points.push_back(p);
    }
  const ConvexPolyhedron solid = convexHull(points).polyhedron;
  std::vector<Vec3> dual;
  for (int f = 0; f < solid.faceCount(); ++f) dual.push_back(solid.plane(f).normal / solid.plane(f).offset);
  return dual;
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
  EXPECT_EQ(hull.report.duplicates_dropped, 8);
  EXPECT_EQ(hull.report.interior_dropped, 1);
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
  for (int v = 0; v < spike.vertexCount(); ++v) most = std::max(most, spike.spokes(v).size());
  EXPECT_EQ(most, 200u);
}

TEST(ConvexHull, SmallLargeAndFarAway_IsTheSameShape) {
  for (double size : {1e-3, 1.0, 100.0})
    for (double away : {0.0, 1e4}) {
      std::vector<Vec3> points;
      for (const Vec3& v : oracle::dodecahedronPoints())
        points.push_back(size * v + Vec3(away, -away, 0.5 * away) * size);
      EXPECT_EQ(convexHull(points).polyhedron.vertexCount(), 20) << size << " at " << away;
      EXPECT_EQ(convexHull(points).polyhedron.faceCount(), 12) << size << " at " << away;
    }
}

// A million sizes away the coordinates are rounded to 1e-10 of the size.
TEST(ConvexHull, FarFromTheOrigin_TheRoundingOfDoublesMergesNothingButFaces) {
  for (const auto& [points, faces] : {std::pair{oracle::dodecahedronPoints(), 12},
                                      {oracle::icosahedronPoints(), 20},
                                      {cuboctahedronPoints(), 14}}) {
    const Hull hull = convexHull(moved(points, {oracle::turned({1, 2, 3}, 0.7), {1e6, -2e6, 5e5}}));
    EXPECT_EQ(hull.polyhedron.faceCount(), faces);
    EXPECT_LT(hull.report.farthest_moved_m, 1e-9);
  }
}

TEST(ConvexHull, OfHundredThousandPointsOnASphere_HasThemAll) {
  Random random(25);
  std::vector<Vec3> points;
  for (int i = 0; i < 100000; ++i) points.push_back(random.direction());
  const Hull hull = convexHull(points);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 100000);
  EXPECT_EQ(hull.polyhedron.faceCount(), 199996);
  expectConvex(hull.polyhedron, 1e-10);
}

TEST(ConvexHull, OfHundredThousandPointsInABall_HasThemInside) {
  Random random(26);
  std::vector<Vec3> points;
  for (int i = 0; i < 100000; ++i) points.push_back(std::cbrt(random.uniform(0, 1)) * random.direction());
  const Hull hull = convexHull(points);
  expectConvex(hull.polyhedron, 1e-10);
  EXPECT_LE(farthestOutside(points, hull.polyhedron), 1e-10);
  EXPECT_EQ(hull.report.interior_dropped, 100000 - hull.polyhedron.vertexCount());
  EXPECT_EQ(hull.report.duplicates_dropped, 0);
}

TEST(ConvexHull, OfAFineGridOnATurnedCube_HasEightVertices) {
  const int n = 130;
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k)
        if (i % n == 0 || j % n == 0 || k % n == 0) points.push_back(Vec3(i, j, k) / n);
  points = moved(points, Random(27).pose(3.0));
  ASSERT_GT(points.size(), 100000u);
  const Hull hull = convexHull(points);
  EXPECT_EQ(hull.polyhedron.vertexCount(), 8);
  EXPECT_EQ(hull.polyhedron.faceCount(), 6);
  expectHullOf(points, hull.polyhedron, 1e-10);
}

TEST(ConvexHull, KeepsEveryCornerOfA1000Gon) {
  Random random(28);
  for (const Pose& X : {Pose(), random.pose(2.0)}) {
    const std::vector<Vec3> prism = moved(oracle::prism(1000, 1.0, 0.5).vertices(), X);
    const Hull drum = convexHull(prism);
    EXPECT_EQ(drum.polyhedron.vertexCount(), 2000);
    EXPECT_EQ(drum.polyhedron.faceCount(), 1002);
    EXPECT_EQ(largestFace(drum.polyhedron), 1000);
    expectHullOf(prism, drum.polyhedron, 1e-10);
    std::vector<Vec3> points = oracle::prism(1000, 1.0, 1e-3).vertices();
    points.resize(1000);
    for (Vec3& p : points) p.z() = 0.0;
    points.insert(points.end(), {{0, 0, 1}, {0, 0, -0.3}});
    points = moved(points, X);
    const Hull spindle = convexHull(points);
    EXPECT_EQ(spindle.polyhedron.vertexCount(), 1002);
    EXPECT_EQ(spindle.polyhedron.faceCount(), 2000);
    EXPECT_EQ(largestDegree(spindle.polyhedron), 1000);
    expectHullOf(points, spindle.polyhedron, 1e-10);
  }
}

// Each corner three times, once for each of its facets, as a triangle soup from a CAD program has it; and
// points all over the faces.
TEST(ConvexHull, OfACoplanarSoupInSinglePrecision_IsTheBox) {
  Random random(29);
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Vec3> soup;
    const ConvexPolyhedron box = boxPolyhedron({1, 2, 3});
    for (int copy = 0; copy < 3; ++copy)
      soup.insert(soup.end(), box.vertices().begin(), box.vertices().end());
    for (int i = 0; i < 1000; ++i) {
      Vec3 p(random.uniform(-0.5, 0.5), random.uniform(-1, 1), random.uniform(-1.5, 1.5));
      p[i % 3] = (i % 2 ? 0.5 : -0.5) * (1 + i % 3);
      soup.push_back(p);
    }
    soup = inSinglePrecision(moved(soup, random.pose(3.0)));
    const Hull hull = convexHull(soup, singlePrecision(soup));
    EXPECT_EQ(hull.polyhedron.vertexCount(), 8) << "trial " << trial;
    EXPECT_EQ(hull.polyhedron.faceCount(), 6) << "trial " << trial;
    EXPECT_EQ(hull.report.duplicates_dropped, 16) << "trial " << trial;
    EXPECT_EQ(hull.report.interior_dropped, 1000) << "trial " << trial;
    EXPECT_LT(hull.report.farthest_moved_m, 4e-7) << "a few roundings of coordinates up to 4";
    EXPECT_LE(farthestOutside(soup, hull.polyhedron), hull.report.farthest_outside_m + 1e-15);
    EXPECT_LT(hull.report.farthest_outside_m, 1e-6);
  }
}

TEST(ConvexHull, OnlyTheCoordinateErrorMakesRoundedFacesWhole) {
  struct Rounded {
    const char* name;
    std::vector<Vec3> points;
    int faces;
  };
  const Rounded solids[] = {
      {"box", boxPolyhedron({1, 2, 3}).vertices(), 6},
      {"dodecahedron", oracle::dodecahedronPoints(), 12},
      {"icosahedron", oracle::icosahedronPoints(), 20},
      {"cuboctahedron", cuboctahedronPoints(), 14},
      {"deltoidal icositetrahedron", deltoidalPoints(), 24},
      {"prism over a 1000-gon", oracle::prism(1000, 1.0, 1.0).vertices(), 1002},
  };
  Random random(30);
  for (const Rounded& solid : solids) {
    SCOPED_TRACE(solid.name);
    const std::vector<Vec3> points = inSinglePrecision(moved(solid.points, random.pose(3.0)));
    const Hull hull = convexHull(points, singlePrecision(points));
    EXPECT_EQ(hull.polyhedron.faceCount(), solid.faces);
    EXPECT_EQ(hull.polyhedron.vertexCount(), static_cast<int>(solid.points.size()));
    expectConvex(hull.polyhedron, 1e-14);
    EXPECT_LT(hull.report.farthest_moved_m, 5e-7);
    const Hull exact = convexHull(points);
    EXPECT_LE(exact.report.farthest_moved_m, 4 * exact.report.tolerance_m);
    EXPECT_LE(farthestOutside(points, exact.polyhedron), 8 * exact.report.tolerance_m);
    expectConvex(exact.polyhedron, 1e-14);
    const bool only_triangles = solid.faces == 20;
    EXPECT_EQ(exact.polyhedron.faceCount() > solid.faces, !only_triangles) << "facets of the rounding";
  }
}

TEST(ConvexHull, CoplanarTolerance_DecidesWhetherALowRoofIsAFace) {
  std::vector<Vec3> points = boxPolyhedron(Vec3::Ones()).vertices();
  points.emplace_back(0, 0, 0.5 + 1e-6);
  EXPECT_EQ(convexHull(points).polyhedron.faceCount(), 9);
  const Hull merged = convexHull(points, {.coplanar_tolerance = 1e-5});
  EXPECT_EQ(merged.polyhedron.faceCount(), 6);
  EXPECT_EQ(merged.report.interior_dropped, 1);
  EXPECT_NEAR(merged.report.farthest_outside_m, 1e-6, 1e-12);
  EXPECT_NEAR(merged.report.tolerance_m, 1e-5 * std::sqrt(3.0), 1e-12);
}

// Where everything is as fine as the tolerance, the answer is a polyhedron all the same and stays near.
TEST(ConvexHull, OfASphereFinerThanItsTolerance_StaysWithinTolerances) {
  Random random(31);
  std::vector<Vec3> points;
  for (int i = 0; i < 5000; ++i) points.push_back(random.direction());
  for (double error : {1e-6, 1e-5, 1e-4}) {
    const Hull hull = convexHull(points, {.coordinate_error_m = error});
    const double asked_m = 16 * error;
    EXPECT_LE(hull.report.tolerance_m, asked_m * (1 + 1e-9));
    EXPECT_LE(hull.report.farthest_moved_m, 4 * asked_m);
    EXPECT_LE(farthestOutside(points, hull.polyhedron), 8 * asked_m);
    expectConvex(hull.polyhedron, 1e-9);
  }
}

TEST(ConvexHull, FeaturesAreNumberedByTheInput) {
  const ConvexPolyhedron box = boxPolyhedron({1, 2, 3});
  EXPECT_EQ(convexHull(box.vertices()).polyhedron.vertices(), box.vertices());
  Random random(32);
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) points.push_back(random.direction().cwiseProduct(Vec3(1, 2, 0.5)));
  const ConvexPolyhedron hull = convexHull(points).polyhedron;
  // Points inside, wherever they stand in the list, change no number.
  std::vector<Vec3> more;
  for (const Vec3& p : points) more.insert(more.end(), {0.5 * p, p});
  const ConvexPolyhedron same = convexHull(more).polyhedron;
  EXPECT_EQ(hull.vertices(), points);
  EXPECT_EQ(same.vertices(), points);
  ASSERT_EQ(same.faceCount(), hull.faceCount());
  for (int f = 0; f < hull.faceCount(); ++f) EXPECT_EQ(same.plane(f).normal, hull.plane(f).normal);
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
