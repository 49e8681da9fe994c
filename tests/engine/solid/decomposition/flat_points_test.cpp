// CutSurface::withoutFlatPoints.
#include <gtest/gtest.h>

#include <map>

#include "engine/solid/decomposition/cut_surface.h"
#include "tests/engine/solid/generated_meshes.h"

namespace carom {
namespace {

using namespace generated;

/// Each triangle in four, with corners in the middle of its sides.
SurfaceMesh divided(const SurfaceMesh& mesh) {
  SurfaceMesh made{mesh.vertices, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [place, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(made.vertices.size()));
    if (is_new)
      made.vertices.push_back(
          0.5 * (mesh.vertices[static_cast<std::size_t>(a)] + mesh.vertices[static_cast<std::size_t>(b)]));
    return place->second;
  };
  for (const Triangle& t : mesh.triangles) {
    const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    for (const Triangle& part :
         {Triangle{t[0], ab, ca}, Triangle{ab, t[1], bc}, Triangle{ca, bc, t[2]}, Triangle{ab, bc, ca}})
      made.triangles.push_back(part);
  }
  return made;
}

SurfaceMesh meshOf(const CutSurface& surface) {
  SurfaceMesh mesh{surface.points(), {}};
  for (int t = 0; t < surface.triangleCount(); ++t) mesh.triangles.push_back(surface.triangle(t));
  return mesh;
}

constexpr double kTolerance = 1e-9;

SurfaceMesh withoutFlatPoints(const SurfaceMesh& mesh) {
  return meshOf(CutSurface(closedSurface(mesh), kTolerance).withoutFlatPoints());
}

// An L has twelve corners, and a closed surface of twelve corners twenty triangles.
TEST(FlatPoints, AreTheOnesThatDividingAdds) {
  const SurfaceMesh ell = cells({2, 1, 2}, [](int x, int, int z) { return x == 0 || z == 0; });
  const SurfaceMesh left = withoutFlatPoints(placed(divided(divided(ell))));
  EXPECT_EQ(left.vertices.size(), 12u);
  EXPECT_EQ(left.triangles.size(), 20u);
  EXPECT_TRUE(isClosed(left));
  EXPECT_NEAR(surfaceMass(left).mass / surfaceMass(ell).mass, 1.0, 1e-12);
}

TEST(FlatPoints, LeaveASurfaceThatIsClosed) {
  for (const SurfaceMesh& mesh :
       {torus(20, 10), gear(12), bowl(12, 4), cup(24),
        cells({5, 5, 1}, [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; })}) {
    const SurfaceMesh given = closedSurface(placed(divided(mesh))).mesh, left = withoutFlatPoints(given);
    EXPECT_LT(left.triangles.size(), given.triangles.size() / 2);
    EXPECT_TRUE(isClosed(left));
    EXPECT_NEAR(surfaceMass(left).mass / surfaceMass(given).mass, 1.0, 1e-9);
  }
}

TEST(FlatPoints, AreNoneThatAreOffByMoreThanRounding) {
  SurfaceMesh bumped = divided(cells({1, 1, 1}, [](int, int, int) { return true; }));
  Vec3& apex = *std::ranges::find_if(bumped.vertices,
                                     [](const Vec3& p) { return (p - Vec3(0.5, 0.5, 1.0)).norm() < 1e-9; });
  apex.z() += 2.0 * kTolerance;
  const SurfaceMesh left = withoutFlatPoints(bumped);
  EXPECT_NE(std::ranges::find(left.vertices, apex), left.vertices.end());
  apex.z() -= 1.5 * kTolerance;
  EXPECT_EQ(withoutFlatPoints(bumped).vertices.size(), 8u);
}

}  // namespace
}  // namespace carom
