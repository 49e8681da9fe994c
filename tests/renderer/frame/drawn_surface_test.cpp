// Solids with a surface of their own are drawn as that, not as their pieces and not as their hull.
#include <gtest/gtest.h>

#include "engine/solid/decomposition/convex_decomposition.h"
#include "renderer/frame/frame_renderer.h"
#include "renderer/mesh/solid_mesh.h"
#include "tests/engine/solid/generated_meshes.h"
#include "tests/oracle/pixel_casting.h"

namespace carom::renderer {
namespace {

constexpr int kWidth = 320, kHeight = 180;
const Camera kAbove{Vec3(0.3, -3.0, 4.0), Vec3(0.0, 0.0, 0.0), 40.0};

Solid surfaceSolid(const SurfaceMesh& mesh, BoundingSurface looks = {}) {
  const ClosedSurface surface = closedSurface(mesh);
  std::vector<ConvexPart> parts;
  for (const ConvexPolyhedron& piece : convexDecomposition(surface).pieces) parts.push_back({piece, 0.0});
  looks.mesh = surface.mesh;
  looks.of_part.assign(parts.size(), 1);
  return Solid(std::move(parts), std::move(looks));
}

TEST(DrawnSurface, ATorusHasAHoleInTheIdImage) {
  const Solid torus = surfaceSolid(generated::torus(20, 10));
  const std::vector<Instance> instances{{0, Pose{}, {0.5f, 0.5f, 0.5f}, false}};
  FrameRenderer renderer({.width = kWidth, .height = kHeight}, {&torus, 1});
  renderer.draw(instances, kAbove);
  const SurfaceImage& surfaces = renderer.surfaces();
  EXPECT_EQ(surfaces.instance[static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth / 2)], kSky);
  // Everywhere what rays through its pieces meet: the same solid, drawn by nobody from its surface.
  const std::vector<oracle::CastBody> bodies{{&torus, Pose{}}};
  const std::vector<oracle::CastPixel> expected =
      oracle::castPixels({kAbove.eye, kAbove.target, kAbove.fov_degrees, kWidth, kHeight}, bodies);
  int seen = 0, wrong = 0, wrong_depths = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      if (!oracle::awayFromOutlines(expected, kWidth, kHeight, x, y)) continue;
      const std::size_t pixel = static_cast<std::size_t>(y * kWidth + x);
      wrong += surfaces.instance[pixel] != expected[pixel].body;
      if (expected[pixel].body < 0) continue;
      ++seen;
      wrong_depths +=
          !(std::abs(static_cast<double>(surfaces.depth.depth_m[pixel]) - expected[pixel].hit.t) < 1e-3);
    }
  EXPECT_GT(seen, 3000);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(wrong_depths, 0);
}

TEST(DrawnSurface, HasTheMeshsTrianglesAndNoSeams) {
  const SurfaceMesh mesh = generated::torus(20, 10);
  const Solid torus = surfaceSolid(mesh);
  for (const Edges edges : {Edges::kSharp, Edges::kShaded, Edges::kBevelled})
    EXPECT_EQ(buildMesh(torus, {edges, 0.01, 16}).indices.size(), 3 * mesh.triangles.size());
  EXPECT_EQ(buildFlatMesh(torus).indices.size(), 3 * mesh.triangles.size());
}

TEST(DrawnSurface, HasTheNormalsAndColoursOfTheFile) {
  BoundingSurface looks;
  const SurfaceMesh mesh = closedSurface(generated::torus(20, 10)).mesh;
  for (const Triangle& t : mesh.triangles) {
    for (const int v : t) {
      const Vec3& p = mesh.vertices[static_cast<std::size_t>(v)];
      looks.normals.push_back((p - Vec3(p.x(), p.y(), 0.0).normalized()).normalized());
    }
    looks.colors.push_back(mesh.vertices[static_cast<std::size_t>(t[0])].x() < 0.0 ? Vec3(1, 0, 0)
                                                                                   : Vec3(0, 0, 1));
  }
  const Solid torus = surfaceSolid(generated::torus(20, 10), looks);
  const TriangleMesh drawn = buildMesh(torus, {Edges::kBevelled, 0.01, 16});
  ASSERT_EQ(drawn.indices.size(), 3 * mesh.triangles.size());
  int red = 0;
  for (const MeshVertex& v : drawn.vertices) {
    const Vec3 p(v.position[0], v.position[1], v.position[2]), n(v.normal[0], v.normal[1], v.normal[2]);
    EXPECT_LT(((p - Vec3(p.x(), p.y(), 0.0).normalized()).normalized() - n).norm(), 1e-6);
    EXPECT_TRUE((v.tint[0] == 255 && v.tint[2] == 0) || (v.tint[0] == 0 && v.tint[2] == 255));
    red += v.tint[0] == 255;
  }
  EXPECT_GT(red, 80);
  const std::vector<Instance> instances{{0, Pose{}, {1.0f, 1.0f, 1.0f}, false}};
  const Image& image =
      FrameRenderer({.width = kWidth, .height = kHeight}, {&torus, 1}).draw(instances, kAbove);
  const auto at = [&](int x, int y) { return &image.rgb[3 * static_cast<std::size_t>(y * kWidth + x)]; };
  const std::uint8_t *left = at(kWidth / 2 - 55, kHeight / 2), *right = at(kWidth / 2 + 55, kHeight / 2);
  EXPECT_GT(left[0], left[2] + 40);
  EXPECT_GT(right[2], right[0] + 40);
}

}  // namespace
}  // namespace carom::renderer
