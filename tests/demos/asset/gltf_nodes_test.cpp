// Nodes of glTF files: placed by the digits that are written, alike on every processor.

#include "demos/asset/gltf_nodes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "demos/asset/mesh_import.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

// A triangle (0 0 0), (1 0 0), (0 1 0) of floats, then its three indices of two bytes.
const std::string kBuffer(
    "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0"
    "\0\0\1\0\2\0",
    42);
constexpr const char* kBufferAsText = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA";

std::string withMesh(const std::string& nodes_and_scenes, const std::string& where) {
  return R"({"asset": {"version": "2.0"}, )" + nodes_and_scenes + R"(,
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
     {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
     {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "buffers": [{"byteLength": 42)" +
         where + "}]}";
}

std::string gltf(const std::string& nodes_and_scenes) {
  return withMesh(nodes_and_scenes,
                  std::string(R"(, "uri": "data:application/octet-stream;base64,)") + kBufferAsText + '"');
}

std::string littleEndian(std::size_t number) {
  std::string bytes;
  for (int i = 0; i < 4; ++i, number >>= 8) bytes += static_cast<char>(number & 0xff);
  return bytes;
}

std::string chunk(const std::string& kind, std::string bytes, char filling) {
  while (bytes.size() % 4 != 0) bytes += filling;
  return littleEndian(bytes.size()) + kind + bytes;
}

std::string glb(const std::string& nodes_and_scenes) {
  const std::string chunks =
      chunk("JSON", withMesh(nodes_and_scenes, ""), ' ') + chunk(std::string("BIN\0", 4), kBuffer, '\0');
  return "glTF" + littleEndian(2) + littleEndian(12 + chunks.size()) + chunks;
}

constexpr const char* kArm = R"("scene": 1, "scenes": [{"nodes": [2]}, {"nodes": [0]}], "nodes": [
  {"translation": [0.1, 0.2, 0.3], "children": [1, 2]},
  {"mesh": 0, "rotation": [0, 0, 0.6, 0.8], "scale": [0.7, -0.3, 1], "translation": [0.1, 0, 0]},
  {"mesh": 0, "matrix": [0, 0.1, 0, 0, -0.1, 0, 0, 0, 0, 0, 0.1, 0, 7.1, 0, 0, 1]}])";

void expectArm(const ImportedMesh& mesh) {
  ASSERT_EQ(mesh.parts.size(), 2u);
  // Turned by the angle whose half has cosine 0.8 and sine 0.6: cosine 0.28, sine 0.96.
  const std::array<Vec3, 3> turned{Vec3(0.2, 0.2, 0.3), Vec3(0.2 + 0.28 * 0.7, 0.2 + 0.96 * 0.7, 0.3),
                                   Vec3(0.2 + 0.96 * 0.3, 0.2 - 0.28 * 0.3, 0.3)};
  const std::array<Vec3, 3> set{Vec3(7.2, 0.2, 0.3), Vec3(7.2, 0.3, 0.3), Vec3(7.1, 0.2, 0.3)};
  ASSERT_EQ(mesh.parts[0].vertices.size(), 3u);
  ASSERT_EQ(mesh.parts[1].vertices.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((mesh.parts[0].vertices[i] - turned[i]).norm(), 1e-15) << i;
    EXPECT_LT((mesh.parts[1].vertices[i] - set[i]).norm(), 4e-15) << i;
  }
  ASSERT_EQ(mesh.parts[0].triangles.size(), 1u);
  EXPECT_EQ(mesh.parts[0].triangles[0][1], 2) << "a mirrored triangle is walked the other way round";
}

TEST(GltfNodes, PlaceMeshesInDoublePrecision) {
  const TemporaryFolder folder;
  expectArm(importMesh(folder.file("arm.gltf", gltf(kArm))));
  expectArm(importMesh(folder.file("arm.glb", glb(kArm))));
}

TEST(GltfNodes, SeveralRootsHangFromOneMore) {
  const TemporaryFolder folder;
  const auto path = folder.file("two.gltf", gltf(R"("scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [
    {"mesh": 0, "translation": [0.1, 0, 0]}, {"mesh": 0, "translation": [0, 0.1, 0]}])"));
  const ImportedMesh mesh = importMesh(path);
  ASSERT_EQ(mesh.parts.size(), 2u);
  EXPECT_EQ(mesh.parts[0].vertices[0], Vec3(0.1, 0.0, 0.0));
  EXPECT_EQ(mesh.parts[1].vertices[0], Vec3(0.0, 0.1, 0.0));
}

TEST(GltfNodes, RotationsOfThreeDigitsTurnWithoutShear) {
  const TemporaryFolder folder;
  const auto path = folder.file("turned.gltf", gltf(R"("scene": 0, "scenes": [{"nodes": [0]}], "nodes": [
    {"mesh": 0, "rotation": [0.707, 0, 0, 0.707]}])"));
  const ImportedMesh mesh = importMesh(path);
  ASSERT_EQ(mesh.parts.size(), 1u);
  EXPECT_LT((mesh.parts[0].vertices[2] - Vec3(0.0, 0.0, 1.0)).norm(), 1e-15);
}

TEST(GltfNodes, AreNoneWhereTheFileIsNoneOrGoesInCircles) {
  const TemporaryFolder folder;
  EXPECT_TRUE(gltfNodes(folder.file("a.obj", gltf(kArm))).nodes.empty());
  EXPECT_TRUE(gltfNodes(folder.file("a.gltf", "{")).nodes.empty());
  EXPECT_TRUE(gltfNodes(folder.file("a.glb", "glTF")).nodes.empty());
  EXPECT_TRUE(
      gltfNodes(folder.file("b.gltf", R"({"nodes": [{"matrix": [1]}], "scenes": []})")).nodes.empty());
  const GltfNodes circle = gltfNodes(
      folder.file("c.gltf", R"({"scenes": [{"nodes": [0]}], "nodes": [{"children": [0, 1e300, -1]}]})"));
  ASSERT_EQ(circle.nodes.size(), 1u);
  EXPECT_EQ(circle.nodes[0].children, (std::vector<int>{0, -1, -1}));
}

}  // namespace
}  // namespace carom::demos
