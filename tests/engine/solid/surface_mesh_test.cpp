#include "engine/solid/surface_mesh.h"

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "engine/solid/decomposition/surface_crossing.h"
#include "tests/engine/solid/generated_meshes.h"
#include "tests/support/thrown_message.h"

namespace carom {
namespace {

using namespace generated;

SurfaceMesh cube() {
  return cells({1, 1, 1}, [](int, int, int) { return true; });
}

std::string refusal(const SurfaceMesh& mesh) {
  return thrownMessage<InputError>([&mesh] { closedSurface(mesh); });
}

TEST(SurfaceMesh, MassOfAHollowCubeIsTheDifferenceOfTwo) {
  const SurfaceMesh outer = cells({3, 3, 3}, [](int, int, int) { return true; });
  const ClosedSurface made = closedSurface(joined(outer, cube(), true, 1.0, Vec3(1.5, 1.0, 1.0)));
  const MassProperties mass = surfaceMass(made.mesh);
  EXPECT_NEAR(mass.mass, 26.0, 1e-12);
  const double x = (27.0 * 1.5 - 2.0) / 26.0;
  EXPECT_LT((mass.center - Vec3(x, 1.5, 1.5)).norm(), 1e-13);
  // Steiner: of each cube about its own middle m (a^2 + a^2) / 12, and m times the square of the way there.
  EXPECT_NEAR(mass.inertia(0, 0), 27.0 * 18.0 / 12.0 - 2.0 / 12.0, 1e-11);
  EXPECT_NEAR(mass.inertia(1, 1),
              27.0 * 18.0 / 12.0 + 27.0 * (x - 1.5) * (x - 1.5) - 2.0 / 12.0 - (x - 2.0) * (x - 2.0), 1e-11);
  EXPECT_EQ(made.cavities, 1);
}

TEST(SurfaceMesh, CountsHandles) {
  EXPECT_EQ(closedSurface(cube()).handles, 0);
  EXPECT_EQ(closedSurface(torus(7, 5)).handles, 1);
  EXPECT_EQ(closedSurface(cells({5, 1, 3}, [](int x, int, int z) { return z != 1 || x % 2 == 0; })).handles,
            2);
}

TEST(SurfaceMesh, TurnsShellsThatFaceInwardsOrBothWays) {
  SurfaceMesh mixed = cube();
  for (std::size_t t = 0; t < mixed.triangles.size(); t += 3)
    std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  const ClosedSurface made = closedSurface(mixed);
  EXPECT_NEAR(surfaceMass(made.mesh).mass, 1.0, 1e-14);
  EXPECT_EQ(made.shells_turned, 1);
  // A cavity that faces outwards, as scanners write it.
  const SurfaceMesh outer = cells({3, 3, 3}, [](int, int, int) { return true; });
  EXPECT_NEAR(surfaceMass(closedSurface(joined(outer, cube(), false, 1.0, Vec3::Ones())).mesh).mass, 26.0,
              1e-12);
}

TEST(SurfaceMesh, WeldsCornersAtEqualPlaces) {
  const SurfaceMesh shared = torus(6, 4);
  SurfaceMesh soup;
  for (const Triangle& t : shared.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int v : t) soup.vertices.push_back(shared.vertices[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(closedSurface(soup).mesh.vertices.size(), shared.vertices.size());
}

TEST(SurfaceMesh, SaysWhereItIsOpen) {
  SurfaceMesh open = cube();
  open.triangles.pop_back();
  EXPECT_NE(refusal(open).find("open: 3 edges have one triangle only, the first from ("), std::string::npos)
      << refusal(open);
  EXPECT_FALSE(isClosed(open));
}

TEST(SurfaceMesh, SaysWhereItIsNotManifold) {
  const SurfaceMesh touching = cells({2, 2, 1}, [](int x, int y, int) { return x == y; });
  EXPECT_NE(
      refusal(touching).find("not manifold: 1 edge has more than two triangles, the first from (1, 1, 0)"),
      std::string::npos)
      << refusal(touching);
}

TEST(SurfaceMesh, RefusesOneWithoutTriangles) {
  EXPECT_NE(refusal({}).find("no triangles"), std::string::npos);
}

TEST(SurfaceCrossing, FindsWhereTwoCubesGoThroughEachOther) {
  const SurfaceMesh crossing = joined(cube(), cube(), false, 1.0, Vec3(0.5, 0.25, 0.25));
  const std::optional<Vec3> p = findCrossing(crossing, 1e-12);
  ASSERT_TRUE(p);
  // On the surface of both, away from the edges of one.
  EXPECT_TRUE(p->x() == 0.5 || p->x() == 1.0 || p->y() == 1.0 || p->z() == 1.0) << p->transpose();
  EXPECT_TRUE(p->x() >= 0.5 && p->x() <= 1.0 && p->y() >= 0.25 && p->z() >= 0.25 && p->y() <= 1.0 &&
              p->z() <= 1.0)
      << p->transpose();
  const SurfaceMesh touching = joined(cube(), cube(), false, 1.0, Vec3(1.0, 0.25, 0.25));
  EXPECT_FALSE(findCrossing(touching, 1e-12));
  EXPECT_FALSE(findCrossing(placed(torus(20, 10)), 1e-12));
}

// Within the box of a U but not within its walls; and within those.
TEST(SurfaceMesh, WhatIsInTheOpeningOfAnotherIsNoCavity) {
  const SurfaceMesh u = cells({3, 1, 3}, [](int x, int, int z) { return x != 1 || z == 0; });
  for (const double x : {1.05, 1.45, 1.8})
    for (const double y : {0.05, 0.45, 0.85})
      for (const double z : {1.05, 1.5, 2.0, 2.5, 2.85}) {
        const ClosedSurface made = closedSurface(joined(u, cube(), false, 0.1, Vec3(x, y, z)));
        EXPECT_EQ(made.cavities, 0) << x << ' ' << y << ' ' << z;
        EXPECT_NEAR(surfaceMass(made.mesh).mass, 7.001, 1e-12) << x << ' ' << y << ' ' << z;
      }
  const ClosedSurface hollow = closedSurface(joined(u, cube(), false, 0.1, Vec3(0.4, 0.3, 1.7)));
  EXPECT_EQ(hollow.cavities, 1);
  EXPECT_NEAR(surfaceMass(hollow.mesh).mass, 6.999, 1e-12);
}

TEST(SurfaceCrossing, FindsATriangleThatGoesThroughOneThatItSharesACornerWith) {
  SurfaceMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}};
  for (const Triangle& through : {Triangle{0, 3, 4}, Triangle{3, 4, 0}, Triangle{4, 0, 3}}) {
    mesh.triangles = {{0, 1, 2}, through};
    const std::optional<Vec3> p = findCrossing(mesh, 1e-12);
    ASSERT_TRUE(p) << "begun at corner " << through[0];
    EXPECT_LT((*p - Vec3(0.5, 0.5, 0.0)).norm(), 1e-15);
  }
  mesh.triangles[1] = {0, 1, 4};
  EXPECT_FALSE(findCrossing(mesh, 1e-12)) << "a side in common";
}

}  // namespace
}  // namespace carom
