// What a stream meets of a mesh is the mesh's surface: its pieces' faces, but for where these lie against
// each other. The oracle is the sum over the mesh's triangles.

#include "engine/environment/solid_surface.h"

#include <gtest/gtest.h>

#include "engine/foundation/index.h"
#include "engine/solid/decomposition/convex_decomposition.h"
#include "tests/engine/solid/generated_meshes.h"

namespace carom {
namespace {

using namespace generated;

struct Areas {
  double whole = 0.0;
  Vec3 pointing = Vec3::Zero();  // of |n . axis| dA, for each axis
};

void add(Areas& sum, const Vec3& normal_area) {
  sum.whole += normal_area.norm();
  sum.pointing += normal_area.cwiseAbs();
}

Areas ofMesh(const SurfaceMesh& mesh) {
  Areas sum;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[at(t[0])], b = mesh.vertices[at(t[1])], c = mesh.vertices[at(t[2])];
    add(sum, 0.5 * (b - a).cross(c - a));
  }
  return sum;
}

Areas ofPieces(const SolidSurface& surface) {
  Areas sum;
  for (const PartSurface& part : surface.parts)
    for (const Facet& facet : part.open->facets)
      add(sum, areaOf(part.open->cornersOf(facet), facet.normal).area_m2 * facet.normal);
  return sum;
}

TEST(SolidSurface, OfAMeshIsTheMeshsOwn) {
  for (const SurfaceMesh& mesh :
       {cells({2, 1, 2}, [](int x, int, int z) { return x == 0 || z == 0; }),
        cells({5, 5, 1}, [](int x, int y, int) { return x % 2 == 0 || y % 2 == 0; }), torus(20, 10), cup(24),
        gear(12), dentedBall(9, 6, 4, 7), dentedBall(9, 6, 3, 8)}) {
    const ClosedSurface closed = closedSurface(placed(mesh));
    std::vector<ConvexPart> parts;
    for (const ConvexPolyhedron& piece : convexDecomposition(closed).pieces) parts.push_back({piece, 0.0});
    BoundingSurface around;
    around.mesh = closed.mesh;
    around.of_part.assign(parts.size(), 1);
    const Solid solid(parts, around);
    const SolidSurface surface = surfaceOf(solid);
    const Areas right = ofMesh(closed.mesh), found = ofPieces(surface);
    EXPECT_NEAR(surface.area_m2 / right.whole, 1.0, 1e-9) << parts.size();
    EXPECT_LT((found.pointing - right.pointing).norm(), 1e-9 * right.whole) << parts.size();
  }
}

}  // namespace
}  // namespace carom
