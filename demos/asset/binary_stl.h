#pragma once
// Binary STL is little-endian; assimp reads its numbers in the processor's own order, so that a big-endian
// one finds no count of triangles that fits the file. Here the file's numbers are turned round for it.
// Tested in tests/demos/asset/binary_stl_test.cpp.

#include <bit>
#include <filesystem>
#include <string>

namespace carom::demos {

/// The file's bytes with its numbers in that order; empty where the file has them so already, and where it is
/// no binary STL.
std::string binaryStlInOrderOf(std::endian order, const std::filesystem::path& path);

}  // namespace carom::demos
