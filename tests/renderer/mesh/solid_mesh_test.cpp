#include "renderer/mesh/solid_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "engine/solid/convex_hull.h"
#include "renderer/mesh/curved_part_mesh.h"
#include "tests/oracle/ray_caster.h"

namespace carom::renderer {
namespace {

Vec3 position(const TriangleMesh& mesh, std::size_t corner) {
  const float* p = mesh.vertices[mesh.indices[corner]].position;
  return Vec3(p[0], p[1], p[2]);
}

double volume(const TriangleMesh& mesh) {
  double six = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    six += position(mesh, i).dot(position(mesh, i + 1).cross(position(mesh, i + 2)));
  return six / 6.0;
}

// Every side of a triangle is some other triangle's side the other way round; sides are told apart by
// position.
bool closed(const TriangleMesh& mesh) {
  using Key = std::array<float, 3>;
  std::map<std::pair<Key, Key>, int> sides;
  const auto key = [&](std::size_t corner) {
    const float* p = mesh.vertices[mesh.indices[corner]].position;
    return Key{p[0], p[1], p[2]};
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      ++sides[{key(i + k), key(i + (k + 1) % 3)}];
      --sides[{key(i + (k + 1) % 3), key(i + k)}];
    }
  for (const auto& [side, sum] : sides)
    if (sum != 0) return false;
  return true;
}

Solid randomHull(std::mt19937& random, int points) {
  std::normal_distribution<double> normal;
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(Vec3(normal(random), normal(random), normal(random)));
  return Solid::polyhedron(convexHull(cloud).polyhedron);
}

TEST(SolidMesh, SharpMeshesHaveTheSolidsVolume) {
  std::mt19937 random(5);
  for (const int points : {4, 6, 12, 60}) {
    const Solid solid = randomHull(random, points);
    const TriangleMesh mesh = buildMesh(solid, {Edges::kSharp, 0.0, 16});
    EXPECT_NEAR(volume(mesh) / solid.volume(), 1.0, 1e-5) << points;
    EXPECT_TRUE(closed(mesh)) << points;
  }
}

TEST(SolidMesh, BevelledMeshesAreClosedAndStayJustInsideTheSolid) {
  std::mt19937 random(6);
  for (int i = 0; i < 30; ++i) {
    const Solid solid = randomHull(random, 4 + i);
    const double bevel = bevelWidth(solid, 1e9);
    const TriangleMesh mesh = buildMesh(solid, {Edges::kBevelled, bevel, 16});
    EXPECT_TRUE(closed(mesh)) << i;
    EXPECT_LT(volume(mesh), solid.volume()) << i;
    EXPECT_GT(volume(mesh), 0.98 * solid.volume()) << i;
    const double tolerance = 1e-6 * solid.radius();
    for (std::size_t k = 0; k < mesh.indices.size(); ++k)
      for (int f = 0; f < solid.parts()[0].core.faceCount(); ++f)
        EXPECT_LT(solid.parts()[0].core.plane(f).signedDistance(position(mesh, k)), tolerance) << i;
  }
}

TEST(SolidMesh, VerticesOfABoxRecedeByLessThanAHundredthOfItsWidth) {
  const Solid box = Solid::box(Vec3(2.0, 2.0, 2.0));
  double farthest = 0.0;
  for (const MeshVertex& v : buildMesh(box, {Edges::kBevelled, bevelWidth(box, 1e9), 16}).vertices)
    farthest = std::max<double>(farthest, std::hypot(v.position[0], v.position[1], v.position[2]));
  EXPECT_LT(farthest, std::sqrt(3.0));
  EXPECT_GT(farthest, std::sqrt(3.0) - 0.02);
}

TEST(SolidMesh, NormalsAreUnitAndFlatFacesKeepTheirs) {
  const Solid box = Solid::box(Vec3(1.0, 2.0, 3.0));
  int flat = 0;
  for (const MeshVertex& v : buildMesh(box, {Edges::kBevelled, 0.05, 16}).vertices) {
    EXPECT_NEAR(std::hypot(v.normal[0], v.normal[1], v.normal[2]), 1.0, 1e-6);
    if (std::max({std::abs(v.normal[0]), std::abs(v.normal[1]), std::abs(v.normal[2])}) > 0.999999f) ++flat;
  }
  EXPECT_EQ(flat, 24);
}

// Nearness is 1 on the edge that a triangle belongs to, and 0 at a bevel's width from it in its face.
TEST(SolidMesh, ShadedEdgesAreSharpAndTurnToTheMeanNormalOfTheirFaces) {
  std::mt19937 random(7);
  for (int i = 0; i < 30; ++i) {
    const Solid solid = randomHull(random, 4 + i);
    const double bevel = 1e-3 * solid.radius();
    const TriangleMesh mesh = buildMesh(solid, {Edges::kShaded, bevel, 16});
    EXPECT_TRUE(closed(mesh)) << i;
    EXPECT_NEAR(volume(mesh) / solid.volume(), 1.0, 1e-5) << i;
    const auto vector = [](const float(&v)[3]) { return Vec3(v[0], v[1], v[2]); };
    for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
      const MeshVertex &a = mesh.vertices[mesh.indices[k]], &middle = mesh.vertices[mesh.indices[k + 2]];
      ASSERT_FLOAT_EQ(a.nearness, 1.0f);
      ASSERT_FLOAT_EQ(mesh.vertices[mesh.indices[k + 1]].nearness, 1.0f);
      const Vec3 along = (position(mesh, k + 1) - position(mesh, k)).normalized();
      const Vec3 across = position(mesh, k + 2) - position(mesh, k);
      const double height = (across - across.dot(along) * along).norm();
      EXPECT_NEAR(1.0 - height / (1.0 - middle.nearness) / bevel, 0.0, height < 2.0 * bevel ? 1.0 : 1e-3);
      const Vec3 n = vector(a.normal), bent = n + vector(a.bend);
      EXPECT_NEAR(bent.norm(), 1.0, 1e-6);
      EXPECT_NEAR(bent.dot(along), 0.0, 1e-5);
      int faces = 0;  // The two that meet in the edge, to which the bent normal leans alike.
      for (int f = 0; f < solid.parts()[0].core.faceCount(); ++f) {
        const Plane& plane = solid.parts()[0].core.plane(f);
        if (std::abs(plane.signedDistance(position(mesh, k))) > 1e-6 * solid.radius() ||
            std::abs(plane.signedDistance(position(mesh, k + 1))) > 1e-6 * solid.radius())
          continue;
        ++faces;
        EXPECT_NEAR(plane.normal.dot(bent), n.dot(bent), 1e-5);
      }
      EXPECT_EQ(faces, 2);
    }
  }
}

/// A frustum along z with that radius below and above; a cone where one is zero.
Solid frustum(int sides, double below, double above) {
  std::vector<Vec3> points;
  for (int k = 0; k < sides; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / sides;
    points.emplace_back(below * std::cos(turn), below * std::sin(turn), -0.7);
    if (above > 0.0) points.emplace_back(above * std::cos(turn), above * std::sin(turn), 0.7);
  }
  if (above == 0.0) points.emplace_back(0.0, 0.0, 0.7);
  return Solid::polyhedron(convexHull(points).polyhedron);
}

TEST(SolidMesh, CylindersAndConesOfManySidesAreCurvedAndNothingElseIs) {
  for (const int sides : {16, 17, 32, 128}) {
    EXPECT_TRUE(isCurved(frustum(sides, 0.5, 0.5).parts()[0].core)) << sides;
    EXPECT_TRUE(isCurved(frustum(sides, 0.5, 0.3).parts()[0].core)) << sides;
    EXPECT_TRUE(isCurved(frustum(sides, 0.5, 0.0).parts()[0].core)) << sides;
  }
  EXPECT_FALSE(isCurved(frustum(12, 0.5, 0.5).parts()[0].core));
  EXPECT_FALSE(isCurved(Solid::box(Vec3(1.0, 2.0, 3.0)).parts()[0].core));
  std::mt19937 random(8);
  for (const int points : {20, 60, 300})
    EXPECT_FALSE(isCurved(randomHull(random, points).parts()[0].core)) << points;
}

// On the side of a cylinder every normal is the radial one, whatever the edges; the rims are bevelled within
// a hundredth of the width, and no gap shows.
TEST(SolidMesh, CurvedPartsAreClosedJustInsideAndSmoothAround) {
  for (const double above : {0.5, 0.3, 0.0})
    for (const Edges edges : {Edges::kSharp, Edges::kShaded, Edges::kBevelled}) {
      const Solid solid = frustum(32, 0.5, above);
      const TriangleMesh mesh = buildMesh(solid, {edges, 0.03, 16});
      EXPECT_TRUE(closed(mesh)) << above;
      EXPECT_LE(volume(mesh), (1.0 + 1e-6) * solid.volume()) << above;
      EXPECT_GT(volume(mesh), (edges == Edges::kSharp ? 0.99999 : 0.98) * solid.volume()) << above;
      double low = 1.0, high = -1.0;
      for (const Vec3& corner : solid.parts()[0].core.vertices())
        low = std::min(low, corner.z()), high = std::max(high, corner.z());
      // The slant turns the side's normals up by the same angle everywhere.
      const double slope = (0.5 - above) / 1.4;
      for (const MeshVertex& v : mesh.vertices) {
        const Vec3 p(v.position[0], v.position[1], v.position[2]), n(v.normal[0], v.normal[1], v.normal[2]);
        EXPECT_NEAR(n.norm(), 1.0, 1e-6);
        for (int f = 0; f < solid.parts()[0].core.faceCount(); ++f)
          EXPECT_LT(solid.parts()[0].core.plane(f).signedDistance(p), 1e-6);
        const Vec3 radial = Vec3(p.x(), p.y(), 0.0).normalized();
        const bool on_side = n.head<2>().norm() > 0.75 && p.head<2>().norm() > 0.1;
        if (on_side && p.z() > low + 0.01 && p.z() < high - 0.01) {
          EXPECT_NEAR(n.dot((radial + slope * Vec3::UnitZ()).normalized()), 1.0, 1e-3) << p.transpose();
        }
      }
    }
}

TEST(SolidMesh, BallsAndCapsulesAreClosedWithTheVolumeOfTheRealOnes) {
  const double pi = std::numbers::pi;
  const TriangleMesh ball = buildMesh(Solid::ball(0.7), {Edges::kSharp, 0.0, 64});
  const TriangleMesh capsule = buildMesh(Solid::capsule(0.3, 0.8), {Edges::kSharp, 0.0, 64});
  EXPECT_TRUE(closed(ball));
  EXPECT_TRUE(closed(capsule));
  EXPECT_NEAR(volume(ball) / (4.0 / 3.0 * pi * 0.343), 1.0, 0.005);
  EXPECT_NEAR(volume(capsule) / (pi * 0.09 * 0.8 + 4.0 / 3.0 * pi * 0.027), 1.0, 0.005);
}

// The volume is Steiner's, which the solid's mass comes from as well; for the box it is written out.
TEST(SolidMesh, RoundedPolyhedraAreClosedWithTheirTrueVolumeAndEveryVertexOnTheTrueSurface) {
  const double pi = std::numbers::pi, r = 0.2;
  const Solid box = Solid::roundedBox(Vec3(1.0, 0.8, 1.4), r);  // its core: 0.6 by 0.4 by 1.0
  const double true_volume = 0.6 * 0.4 * 1.0 + 2.0 * r * (0.6 * 0.4 + 0.4 * 1.0 + 1.0 * 0.6) +
                             pi * r * r * (0.6 + 0.4 + 1.0) + 4.0 / 3.0 * pi * r * r * r;
  EXPECT_NEAR(volume(buildMesh(box, {Edges::kBevelled, 0.01, 64})) / true_volume, 1.0, 0.002);
  std::mt19937 random(8);
  for (int i = 0; i < 12; ++i) {
    const double radius_m = 0.05 + 0.1 * i;
    const Solid hull({{randomHull(random, 4 + 3 * i).parts()[0].core, radius_m}});
    for (const Edges edges : {Edges::kSharp, Edges::kShaded, Edges::kBevelled}) {
      const TriangleMesh mesh = buildMesh(hull, {edges, 0.01, 64});
      EXPECT_TRUE(closed(mesh)) << i;
      EXPECT_LT(volume(mesh), hull.volume()) << i;
      EXPECT_GT(volume(mesh), 0.995 * hull.volume()) << i;
      for (const MeshVertex& v : mesh.vertices) {
        const Vec3 p(v.position[0], v.position[1], v.position[2]), n(v.normal[0], v.normal[1], v.normal[2]);
        const Vec3 away = p - oracle::nearestOnCore(p, hull.parts()[0].core);
        ASSERT_NEAR(away.norm(), radius_m, 1e-5) << i;
        ASSERT_LT((away / radius_m - n).norm(), 1e-4) << i;
      }
    }
  }
}

TEST(SolidMesh, TheBevelOfALargeGroundIsCapped) {
  EXPECT_DOUBLE_EQ(bevelWidth(Solid::box(Vec3(40.0, 40.0, 10.0)), 0.004), 0.004);
}

}  // namespace
}  // namespace carom::renderer
