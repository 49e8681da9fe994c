#pragma once
// The other files that a mesh file is read with, found in its text: materials and pictures of OBJ, buffers
// and pictures of glTF. A scene's fingerprint has their bytes too. Tested in
// tests/demos/asset/mesh_picture_test.cpp.

#include <filesystem>
#include <vector>

namespace carom::demos {

/// Those that are there, in the order in which they are named.
std::vector<std::filesystem::path> filesNamedBy(const std::filesystem::path& mesh);

}  // namespace carom::demos
