// Pictures that mesh files are covered with: found, placed, and told where they are left out.
#include <gtest/gtest.h>

#include <string>

#include "demos/asset/jpeg_picture.h"
#include "demos/asset/mesh_companions.h"
#include "demos/asset/mesh_solid.h"
#include "demos/asset/picture_file.h"
#include "engine/foundation/contract.h"
#include "renderer/image/png.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

// A cube of one metre whose upper face alone is covered: u along x, v along y.
constexpr const char* kCube = R"(mtllib cube.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl plain
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
usemtl covered
f 5/1 6/2 7/3 8/4
)";
constexpr const char* kMaterials = "newmtl plain\nKd 0.5 0.5 0.5\nnewmtl covered\nKd 1 1 1\nmap_Kd ";

/// Red, green / blue, white from the upper left corner.
SurfacePicture fourColors() {
  return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}};
}
std::string png(const SurfacePicture& picture) {
  const std::vector<std::uint8_t> bytes =
      renderer::encodeSmallPng(renderer::Image{picture.width, picture.height, picture.rgb});
  return std::string(bytes.begin(), bytes.end());
}

std::filesystem::path coveredCube(const TemporaryFolder& folder, const std::string& picture) {
  folder.file("cube.mtl", std::string(kMaterials) + picture + "\n");
  return folder.file("cube.obj", kCube);
}

TEST(MeshPicture, LiesOnTheFaceThatHasIt) {
  const TemporaryFolder folder;
  folder.file("four.png", png(fourColors()));
  const MeshSolid made = meshSolid(coveredCube(folder, "four.png"));
  EXPECT_EQ(made.report.pictures, 1);
  EXPECT_TRUE(made.report.notes.empty());
  ASSERT_EQ(made.surface.pictures.size(), 1u);
  EXPECT_EQ(made.surface.pictures[0], fourColors());
  ASSERT_EQ(made.surface.picture_of.size(), made.surface.mesh.triangles.size());
  int covered = 0;
  for (std::size_t t = 0; t < made.surface.mesh.triangles.size(); ++t) {
    if (made.surface.picture_of[t] < 0) continue;
    ++covered;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = made.surface.mesh.vertices[static_cast<std::size_t>(made.surface.mesh.triangles[t][k])];
      EXPECT_NEAR(p.z(), 1.0, 1e-6);
      EXPECT_NEAR((made.surface.uv[3 * t + k] - Vec2(p.x(), 1.0 - p.y())).norm(), 0.0, 1e-6);
    }
  }
  EXPECT_EQ(covered, 2);
}

TEST(MeshPicture, ThatIsMissingOrDamagedIsTold) {
  const TemporaryFolder folder;
  folder.file("not.png", "no picture at all");
  folder.file("cut.png", png(fourColors()).substr(0, 40));
  for (const char* const name : {"missing.png", "not.png", "cut.png"}) {
    const MeshSolid made = meshSolid(coveredCube(folder, name));
    EXPECT_EQ(made.report.pictures, 0) << name;
    ASSERT_EQ(made.report.notes.size(), 1u) << name;
    EXPECT_EQ(made.report.notes[0].rfind("picture left out: ", 0), 0u) << made.report.notes[0];
    EXPECT_NE(made.report.notes[0].find(name), std::string::npos) << made.report.notes[0];
  }
}

TEST(MeshPicture, InJpegIsReadOrTold) {
  const std::string damaged = "\xff\xd8\xff\xe0 and no more";
  const std::string message = thrownMessage<InputError>([&damaged] {
    decodePicture({reinterpret_cast<const std::uint8_t*>(damaged.data()), damaged.size()}, "wood.jpg");
  });
  EXPECT_EQ(message.rfind("wood.jpg: ", 0), 0u) << message;
  EXPECT_EQ(message.find("reads no JPEG") == std::string::npos, readsJpeg()) << message;
}

TEST(MeshPicture, BelongsToTheFilesOfItsMesh) {
  const TemporaryFolder folder;
  folder.file("four.png", png(fourColors()));
  const auto mesh = coveredCube(folder, "-s 1 1 1 four.png");
  const std::vector<std::filesystem::path> files = filesNamedBy(mesh);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].filename(), "cube.mtl");
  EXPECT_EQ(files[1].filename(), "four.png");
  const auto gltf =
      folder.file("a.gltf", R"({"images": [{"uri": "four.png"}, {"uri": "data:image/png;base64,"}]})");
  ASSERT_EQ(filesNamedBy(gltf).size(), 1u);
}

TEST(MeshPicture, OfALookNeedsNoClosedSurface) {
  const TemporaryFolder folder;
  const auto leaf = folder.file("leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  MeshFiles files;
  MeshReport report;
  const BoundingSurface look = meshLook(leaf, {}, files, report);
  EXPECT_EQ(look.mesh.triangles.size(), 2u) << "one for each side";
  EXPECT_EQ(report.triangles, 2);
  EXPECT_NE(thrownMessage<InputError>([&leaf] { meshSolid(leaf); }), "");
}

}  // namespace
}  // namespace carom::demos
