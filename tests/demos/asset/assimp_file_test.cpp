// Meshes whose numbers are turned round for a big-endian processor, and OFF without comments.

#include "demos/asset/assimp_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "demos/asset/mesh_import.h"
#include "demos/format/base64.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

std::string bytesOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::filesystem::path shipped(const char* name) {
  return std::filesystem::path(CAROM_SOURCE_DIR) / "assets/meshes" / name;
}

TEST(AssimpFile, EachNumberOfABinaryStl) {
  const std::string before = bytesOf(shipped("pyramid.stl"));
  const AssimpFile turned = assimpFile(shipped("pyramid.stl"), std::endian::big);
  const std::string& after = turned.bytes;
  EXPECT_EQ(turned.ending, "stl");
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after.substr(0, 80), before.substr(0, 80));
  const auto number = [&](std::size_t at, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      ASSERT_EQ(after[at + i], before[at + size - 1 - i]) << "byte " << at + i;
  };
  number(80, 4);
  for (std::size_t triangle = 84; triangle < before.size(); triangle += 50) {
    for (std::size_t i = 0; i < 12; ++i) number(triangle + 4 * i, 4);
    number(triangle + 48, 2);
  }
}

TEST(AssimpFile, LeavesWhatNeedsNone) {
  EXPECT_EQ(assimpFile(shipped("pyramid.stl"), std::endian::little).bytes, "");
  EXPECT_EQ(assimpFile(shipped("dumbbell.gltf"), std::endian::little).bytes, "");
  EXPECT_EQ(assimpFile(shipped("wedge.stl"), std::endian::big).bytes, "") << "text";
  EXPECT_EQ(assimpFile(shipped("prism.ply"), std::endian::big).bytes, "") << "says its order itself";
  const TemporaryFolder folder;
  const std::string whole = bytesOf(shipped("pyramid.stl"));
  const auto cut = folder.file("cut.stl", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(assimpFile(cut, std::endian::big).bytes, "");
  EXPECT_EQ(assimpFile(folder.file("none.gltf", "{"), std::endian::big).bytes, "");
  EXPECT_EQ(assimpFile(folder.file("none.glb", "glTF"), std::endian::big).bytes, "");
}

std::string embedded(const std::string& bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return base64({data, bytes.size()});
}

// Two numbers of four bytes twice, one array within the other; then two of two, two of one, a sparse index
// and its value.
TEST(AssimpFile, EachNumberOfGltfOnce) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.gltf", R"({"asset": {"version": "2.0"},
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC2"},
     {"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 1, "type": "SCALAR"},
     {"bufferView": 1, "componentType": 5123, "count": 2, "type": "SCALAR"},
     {"bufferView": 2, "componentType": 5121, "count": 2, "type": "SCALAR"},
     {"componentType": 5126, "count": 1, "type": "SCALAR", "sparse": {"count": 1,
      "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 3, "byteOffset": 2}}}],
    "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": 4},
     {"buffer": 0, "byteOffset": 12, "byteLength": 2}, {"buffer": 0, "byteOffset": 14, "byteLength": 6}],
    "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,)" +
                                              embedded("abcdefghijklmnopqrst") + R"("}]})");
  const AssimpFile turned = assimpFile(path, std::endian::big);
  EXPECT_EQ(turned.ending, "gltf");
  EXPECT_NE(turned.bytes.find(embedded("dcbahgfejilkmnpotsrq")), std::string::npos) << turned.bytes;
  EXPECT_EQ(turned.bytes.find(embedded("abcdefghijklmnopqrst")), std::string::npos) << turned.bytes;
}

TEST(AssimpFile, OffHasNoCommentsAndNoEmptyLines) {
  const TemporaryFolder folder;
  const auto path =
      folder.file("a.off", "OFF\n# by hand\n3 1 0 # counts\n\n0 0 0\r\n1 0 0\n#\n0 1 0\n3 0 1 2\n");
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const AssimpFile file = assimpFile(path, order);
    EXPECT_EQ(file.bytes, "OFF\n3 1 0 \n0 0 0\r\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(file.ending, "off");
  }
  EXPECT_EQ(importMesh(path).parts.size(), 1u);
  EXPECT_EQ(assimpFile(shipped("icosahedron.off"), std::endian::little).bytes, "") << "has none";
}

}  // namespace
}  // namespace carom::demos
