// A page's meshes are the renderer's, within a grid step and a tenth of a degree; equal shapes of different
// size are one; the ground is found.
#include "demos/page/page_shapes.h"

#include <gtest/gtest.h>

#include "demos/language/scene_choice.h"
#include "demos/language/scene_file.h"
#include "renderer/image/png.h"
#include "renderer/mesh/solid_mesh.h"
#include "tests/demos/support/whole_reader.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

SceneWorld worldOf(const std::string& bodies) {
  return makeSceneWorld(parseScene(R"({ "format": 1, "bodies": [)" + bodies + "] }", "test.json"),
                        std::nullopt);
}

struct ReadMesh {
  std::vector<std::int64_t> x, y, z, u, v, indices;
  std::array<std::vector<std::int64_t>, 3> places;
};

std::vector<ReadMesh> readMeshes(const PageShapes& shapes) {
  ByteStream out;
  shapes.write(out);
  WholeReader reader(out.bytes());
  std::vector<ReadMesh> meshes(static_cast<std::size_t>(reader.whole()));
  for (ReadMesh& mesh : meshes) {
    const auto vertices = static_cast<std::size_t>(reader.whole()),
               triangles = static_cast<std::size_t>(reader.whole());
    const bool has_colors = reader.whole() == 1, has_places = reader.whole() == 1;
    for (std::vector<std::int64_t>* column : {&mesh.x, &mesh.y, &mesh.z, &mesh.u, &mesh.v})
      *column = reader.differences(vertices);
    for (int i = 0; has_colors && i < 3; ++i) reader.differences(vertices);
    for (std::size_t i = 0; has_places && i < 3; ++i) mesh.places[i] = reader.differences(vertices);
    mesh.indices = reader.differences(3 * triangles);
  }
  EXPECT_TRUE(reader.atEnd());
  return meshes;
}

Vec3 unfolded(double x, double y) {
  Vec3 n(x, y, 1.0 - std::abs(x) - std::abs(y));
  if (n.z() < 0.0)
    n.head<2>() =
        Vec2((1.0 - std::abs(y)) * (x < 0.0 ? -1.0 : 1.0), (1.0 - std::abs(x)) * (y < 0.0 ? -1.0 : 1.0));
  return n.normalized();
}

TEST(PageShapes, AreTheRenderersTriangles) {
  const SceneWorld made = worldOf(
      R"({ "name": "wedge", "shape": { "wedge": [2, 0.7, 0.4] }, "position": [0, 0, 5] },
         { "name": "ball", "shape": { "sphere": { "radius": 0.3 } }, "position": [4, 0, 5] })");
  PagePictures pictures;
  const PageShapes shapes(made, pictures);
  const std::vector<ReadMesh> meshes = readMeshes(shapes);
  for (std::size_t body = 0; body < 2; ++body) {
    const Solid& solid = made.world.solids()[static_cast<std::size_t>(made.world.bodies()[body].solid)];
    const PlacedMesh& placed = shapes.of(body);
    const ReadMesh& read = meshes[static_cast<std::size_t>(placed.mesh)];
    // The widest bevel that it may have is capped by the typical solid; a width changes places, not numbers.
    const double cap = 0.05 * std::min(renderer::thinnestPart(made.world.solids()[0]),
                                       renderer::thinnestPart(made.world.solids()[1]));
    const renderer::TriangleMesh mesh =
        renderer::buildMesh(solid, {renderer::Edges::kBevelled, renderer::bevelWidth(solid, cap), 64});
    ASSERT_EQ(read.x.size(), mesh.vertices.size());
    ASSERT_EQ(read.indices.size(), mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) EXPECT_EQ(read.indices[i], mesh.indices[i]);
    const Vec3 size = placed.high - placed.low;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const auto& v = mesh.vertices[i];
      const Vec3 grid(static_cast<double>(read.x[i]), static_cast<double>(read.y[i]),
                      static_cast<double>(read.z[i]));
      const Vec3 p = placed.low + grid.cwiseProduct(size) / 65535.0;
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(p[k], static_cast<double>(v.position[k]), 0.5001 * size[k] / 65535.0 + 1e-7);
      const Vec3 n(static_cast<double>(v.normal[0]), static_cast<double>(v.normal[1]),
                   static_cast<double>(v.normal[2]));
      EXPECT_LT(
          (unfolded(static_cast<double>(read.u[i]) / 1023.0, static_cast<double>(read.v[i]) / 1023.0) - n)
              .norm(),
          0.0018);
    }
  }
}

TEST(PageShapes, BallsOfAnySizeShareAMesh) {
  std::string bodies;
  for (int i = 1; i <= 12; ++i)
    bodies += std::string(i > 1 ? "," : "") + "{ \"name\": \"b" + std::to_string(i) +
              "\", \"shape\": { \"sphere\": { \"radius\": " + std::to_string(0.1 * i) +
              " } }, \"position\": [" + std::to_string(4 * i) + ", 0, 5] }";
  const SceneWorld made = worldOf(bodies);
  PagePictures pictures;
  const PageShapes shapes(made, pictures);
  EXPECT_EQ(readMeshes(shapes).size(), 1u);
  EXPECT_NEAR((shapes.of(11).high - shapes.of(11).low).x(), 2.4, 0.01);
}

// Two bodies with a mesh and pictures in their place, one of them with another picture.
TEST(PageShapes, AreThoseOfWhatIsDrawnInPlaceOfABody) {
  const TemporaryFolder folder;
  const auto write = [&folder](const std::string& name, std::uint8_t red) {
    const std::vector<std::uint8_t> bytes = renderer::encodeSmallPng(renderer::Image{1, 1, {red, 7, 9}});
    folder.file(name + ".png", std::string(bytes.begin(), bytes.end()));
    folder.file(name + ".mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + name + ".png\n");
    folder.file(name + ".obj", "mtllib " + name +
                                   ".mtl\nv 0 0 0\nv 2 0 0\nv 0 2 1\nvt 0 0\nvt 2.5 0\nvt 0 0.25\n"
                                   "usemtl m\nf 1/1 2/2 3/3\n");
  };
  write("one", 10);
  write("two", 20);
  const auto body = [](const std::string& name, int x, const std::string& mesh) {
    return "{ \"name\": \"" + name + R"(", "shape": { "box": [9, 9, 9] }, "position": [)" +
           std::to_string(x) + R"(, 0, 9], "visual": { "file": ")" + mesh + ".obj\" } }";
  };
  const SceneWorld made =
      makeSceneWorld(parseScene("{ \"format\": 1, \"bodies\": [" + body("a", 0, "one") + "," +
                                    body("b", 20, "two") + "," + body("c", 40, "two") + "] }",
                                folder.path() / "scene.json"),
                     std::nullopt);
  PagePictures pictures;
  const PageShapes shapes(made, pictures);
  const std::vector<ReadMesh> meshes = readMeshes(shapes);
  ASSERT_EQ(meshes.size(), 2u)
      << "boxes are not drawn; the same triangles with another picture are not the same";
  EXPECT_NE(shapes.of(0).mesh, shapes.of(1).mesh);
  EXPECT_EQ(shapes.of(1).mesh, shapes.of(2).mesh);
  EXPECT_LT((shapes.of(0).low - Vec3::Zero()).norm(), 1e-6);
  EXPECT_LT((shapes.of(0).high - Vec3(2, 2, 1)).norm(), 1e-6);
  for (std::size_t which = 0; which < 2; ++which) {
    const ReadMesh& mesh = meshes[static_cast<std::size_t>(shapes.of(which).mesh)];
    ASSERT_EQ(mesh.places[0].size(), mesh.x.size());
    for (std::size_t i = 0; i < mesh.x.size(); ++i) {
      EXPECT_EQ(mesh.places[0][i], mesh.x[i] > 0 ? 5 * 32768 : 0);
      EXPECT_EQ(mesh.places[1][i], 65536 - (mesh.y[i] > 0 ? 16384 : 0)) << "from the upper edge down";
      EXPECT_EQ(mesh.places[2][i], static_cast<std::int64_t>(which));
    }
  }
}

TEST(PageGround, IsTheLowestLevelTopOfAChecker) {
  const std::string checker = R"("static": true, "material": { "checker": true })";
  const SceneWorld made = worldOf(
      R"({ "name": "high", "shape": { "box": [2, 2, 1] }, "position": [9, 0, 2.5], )" + checker + R"( },
         { "name": "low", "shape": { "box": [20, 20, 1] }, "position": [0, 0, -1.5], )" +
      checker + R"( },
         { "name": "tilted", "shape": { "box": [2, 2, 1] }, "position": [-9, 0, -9],
           "rotation": { "axis": [1, 0, 0], "degrees": 20 }, )" +
      checker + R"( },
         { "name": "ball", "shape": { "sphere": { "radius": 0.3 } }, "position": [0, 0, 5] })");
  const std::optional<PageGround> ground = pageGround(made);
  ASSERT_TRUE(ground);
  EXPECT_EQ(made.names[static_cast<std::size_t>(ground->body)], "low");
  EXPECT_NEAR(ground->z_m, -1.0, 1e-12);
  EXPECT_FALSE(pageGround(worldOf(R"({ "name": "ball", "shape": { "sphere": { "radius": 0.3 } } })")));
}

}  // namespace
}  // namespace carom::demos
