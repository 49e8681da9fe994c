// Faces bent by rounding become planar, by the shortest way.

#include "engine/solid/planar_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using Loops = std::vector<std::vector<int>>;

Loops loopsOf(const ConvexPolyhedron& p) {
  Loops loops;
  for (int f = 0; f < p.faceCount(); ++f)
    loops.emplace_back(p.faceVertices(f).begin(), p.faceVertices(f).end());
  return loops;
}

// A square pyramid with one corner of the base raised by h: the bend is the pattern +1 -1 +1 -1 times h/4,
// and pushing each corner back by its share is the shortest way, apart from terms in h squared.
TEST(PlanarFaces, OneRaisedCornerIsSharedByAllFour) {
  const double h = 1e-6;
  std::vector<Vec3> vertices{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, h}, {0, 0, 2}};
  const Loops loops{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const std::vector<Vec3> before = vertices;
  EXPECT_NEAR(largestBend(vertices, loops), h / 4, h * h);
  EXPECT_NEAR(flattenFaces(vertices, loops), h / 4, h * h);
  EXPECT_LT(largestBend(vertices, loops), 1e-15);
  const double shares[] = {h / 4, -h / 4, h / 4, -h / 4};
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT((vertices[i] - before[i] - Vec3(0, 0, shares[i])).norm(), 4 * h * h) << i;
  EXPECT_EQ(vertices[4], before[4]) << "triangles are planar whatever happens";
}

TEST(PlanarFaces, NoiseOnAnySolidIsTakenOut) {
  oracle::Random random(71);
  for (const ConvexPolyhedron& solid :
       {boxPolyhedron({1, 2, 3}), oracle::dodecahedron(), oracle::prism(7, 1, 2), oracle::prism(200, 1, 0.3)})
    for (double noise : {1e-9, 1e-6, 1e-5}) {
      const Pose X = random.pose(2.0);
      std::vector<Vec3> vertices;
      for (const Vec3& v : solid.vertices()) vertices.push_back(X * v + noise * random.direction());
      const double bend = largestBend(vertices, loopsOf(solid));
      EXPECT_GT(bend, 0.01 * noise);
      const double farthest = flattenFaces(vertices, loopsOf(solid));
      EXPECT_LT(largestBend(vertices, loopsOf(solid)), 1e-14);
      EXPECT_GT(farthest, 0.5 * bend) << "a bend cannot vanish with less";
      EXPECT_LT(farthest, 20 * noise);
    }
}

// Where three faces meet in every corner, each of them may be pushed along its normal and all stay planar:
// the shortest displacements have nothing of that, but for terms in the square of the noise.
TEST(PlanarFaces, NoFaceIsPushedWithoutNeed) {
  oracle::Random random(73);
  const double noise = 1e-6;
  for (const ConvexPolyhedron& solid :
       {boxPolyhedron({1, 2, 3}), oracle::dodecahedron(), oracle::prism(7, 1, 2)})
    for (int i = 0; i < 20; ++i) {
      std::vector<Vec3> vertices;
      for (const Vec3& v : solid.vertices()) vertices.push_back(v + noise * random.direction());
      const std::vector<Vec3> before = vertices;
      flattenFaces(vertices, loopsOf(solid));
      for (int f = 0; f < solid.faceCount(); ++f) {
        double along = 0.0;
        for (const int v : solid.faceVertices(f)) {
          std::vector<Vec3> others;  // normals of the other two faces there
          for (int g = 0; g < solid.faceCount(); ++g)
            if (g != f && std::ranges::count(solid.faceVertices(g), v) > 0)
              others.push_back(solid.plane(g).normal);
          ASSERT_EQ(others.size(), 2u);
          const Vec3 edge = others[0].cross(others[1]);
          const auto at = static_cast<std::size_t>(v);
          along += (vertices[at] - before[at]).dot(edge) / edge.dot(solid.plane(f).normal);
        }
        EXPECT_LT(std::abs(along), 1e-3 * noise) << f;
      }
    }
}

TEST(PlanarFaces, PlanarOnesStayWhereTheyAre) {
  std::vector<Vec3> vertices = boxPolyhedron({1, 2, 3}).vertices();
  EXPECT_EQ(flattenFaces(vertices, loopsOf(boxPolyhedron({1, 2, 3}))), 0.0);
  EXPECT_EQ(vertices, boxPolyhedron({1, 2, 3}).vertices());
}

TEST(PlanarFaces, FarFromTheOriginTheyAreAsPlanarAsCoordinatesAllow) {
  oracle::Random random(72);
  const ConvexPolyhedron solid = oracle::dodecahedron();
  std::vector<Vec3> vertices;
  for (const Vec3& v : solid.vertices())
    vertices.push_back(v + Vec3(1e4, -2e4, 5e3) + 1e-5 * random.direction());
  flattenFaces(vertices, loopsOf(solid));
  EXPECT_LT(largestBend(vertices, loopsOf(solid)), 1e-11) << "coordinates of 2e4 round by 2e-12";
}

// By a shift that keeps all digits of the corners, though not of their mean.
TEST(PlanarFaces, BendByAsMuchFarFromTheOrigin) {
  const Loops loops{{0, 1, 2, 3, 4}};
  const std::vector<Vec3> near{
      {1, 0, 0}, {0.5, 1, 0.25}, {-0.5, 0.5, 0}, {-1, -0.25, -0.125}, {0.25, -1, 0.25}};
  std::vector<Vec3> far;
  for (const Vec3& v : near) far.emplace_back(v + Vec3(0x1p27, -0x1p26, 0x1p25));
  EXPECT_NEAR(largestBend(far, loops), largestBend(near, loops), 1e-6);
}

// The same over an oblong, whose sides are no axes of its plane: the pattern is that of the product of the
// two coordinates along the sides.
TEST(PlanarFaces, OneRaisedCornerIsSharedByAllFour_HoweverTheFaceIsTurned) {
  const double h = 1e-6;
  const Loops loops{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const double shares[] = {h / 4, -h / 4, h / 4, -h / 4};
  for (const double angle : {0.3, 1.0, 2.2}) {
    std::vector<Vec3> vertices{{2, 1, 0}, {-2, 1, 0}, {-2, -1, 0}, {2, -1, h}, {0, 0, 2}};
    for (Vec3& v : vertices) v = oracle::turned(Vec3::UnitZ(), angle) * v;
    const std::vector<Vec3> before = vertices;
    EXPECT_NEAR(largestBend(vertices, loops), h / 4, 4 * h * h) << angle;
    EXPECT_NEAR(flattenFaces(vertices, loops), h / 4, 4 * h * h) << angle;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((vertices[i] - before[i] - Vec3(0, 0, shares[i])).norm(), 10 * h * h) << angle << ' ' << i;
    EXPECT_LT((vertices[4] - before[4]).norm(), 1e-12) << angle;
  }
}

}  // namespace
}  // namespace carom
