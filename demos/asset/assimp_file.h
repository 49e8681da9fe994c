#pragma once
// What assimp is given in place of a file that it would not read, or not read to the end. Binary STL and the
// arrays of glTF are little-endian; assimp reads their numbers in the processor's own order, so that a
// big-endian one finds no triangles: they are turned round for it. Comments in OFF keep its version 6 busy
// for ever: they are left out. Tested in tests/demos/asset/assimp_file_test.cpp.

#include <bit>
#include <filesystem>
#include <string>

namespace carom::demos {

struct AssimpFile {
  std::string bytes;
  std::string ending;  ///< Of the format: "stl", "gltf", "off".
};

/// For a processor of that order; empty where the file itself will do, and where it cannot be read or is not
/// as its format says.
AssimpFile assimpFile(const std::filesystem::path& path, std::endian order);

}  // namespace carom::demos
