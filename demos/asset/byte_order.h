#pragma once
// Binary STL and the arrays of glTF are little-endian; assimp reads their numbers in the processor's own
// order, so that a big-endian one finds no triangles. Here the file's numbers are turned round for it.
// Tested in tests/demos/asset/byte_order_test.cpp.

#include <bit>
#include <filesystem>
#include <string>

namespace carom::demos {

/// What assimp is to read in place of a file, and as a file of which ending ("stl", "gltf").
struct TurnedFile {
  std::string bytes;
  std::string ending;
};

/// The file with its numbers in that order; empty where it has them so already, where it has none but in
/// text, and where it cannot be read or is not as its format says.
TurnedFile inOrderOf(std::endian order, const std::filesystem::path& path);

}  // namespace carom::demos
