// Which planes through a notch leave none there.
#include "engine/solid/decomposition/cut_surface.h"

#include <gtest/gtest.h>

#include <numbers>

#include "engine/foundation/elementary.h"
#include "tests/engine/solid/generated_meshes.h"

namespace carom {
namespace {

using namespace generated;

// From the one notch of an L one facet goes on along x, the other up along z. A plane has one on either side,
// or contains one, where its direction is in the first quarter or the third.
TEST(CutSurface, APlaneDividesANotchBetweenItsFacets) {
  const SurfaceMesh ell = cells({2, 1, 2}, [](int x, int, int z) { return x == 0 || z == 0; });
  // The last but one has its notch across the way from the origin, the last one in the origin.
  for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(40, -30, 0.5), Vec3(5, -0.5, 3), Vec3(-1, -0.5, -1)}) {
    const Quat turn = rotationBy(Vec3(0.3, -0.7, 1.1));
    SurfaceMesh mesh = ell;
    for (Vec3& p : mesh.vertices) p = turn * (p + shift);
    const CutSurface surface(closedSurface(mesh), 1e-9);
    const std::vector<int> notches = surface.notches();
    ASSERT_EQ(notches.size(), 1u);
    for (int degrees = 0; degrees < 360; degrees += 5) {
      const double angle = degrees * std::numbers::pi / 180.0;
      const Vec3 normal = turn * Vec3(-std::sin(angle), 0.0, std::cos(angle));
      const Plane plane{normal, normal.dot(surface.point(surface.tail(notches[0])))};
      EXPECT_EQ(surface.divides(plane, notches[0]), degrees % 180 <= 90) << degrees << " degrees";
      EXPECT_EQ(surface.divides(plane, surface.mate(notches[0])), degrees % 180 <= 90)
          << degrees << " degrees";
    }
  }
}

}  // namespace
}  // namespace carom
