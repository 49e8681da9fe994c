// Binary STL with its numbers turned round.

#include "demos/asset/binary_stl.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

std::string bytesOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::filesystem::path pyramid() {
  return std::filesystem::path(CAROM_SOURCE_DIR) / "assets/meshes/pyramid.stl";
}

TEST(BinaryStl, TurnsEachNumberRound) {
  const std::string before = bytesOf(pyramid()), after = binaryStlInOrderOf(std::endian::big, pyramid());
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

TEST(BinaryStl, LeavesWhatNeedsNone) {
  EXPECT_EQ(binaryStlInOrderOf(std::endian::little, pyramid()), "");
  TemporaryFolder folder;
  EXPECT_EQ(binaryStlInOrderOf(std::endian::big, folder.file("a.stl", "solid a\nendsolid a\n")), "");
  const std::string whole = bytesOf(pyramid());
  EXPECT_EQ(binaryStlInOrderOf(std::endian::big, folder.file("cut.stl", whole.substr(0, whole.size() - 1))),
            "");
  EXPECT_EQ(binaryStlInOrderOf(std::endian::big, folder.file("other.obj", whole)), "");
}

}  // namespace
}  // namespace carom::demos
