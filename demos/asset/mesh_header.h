#pragma once
// What the head of a mesh file says of its length, held against the file before anything is read or allocated
// by its word: an OFF or PLY file of a few bytes may claim billions of vertices. Tested in
// tests/demos/asset/mesh_import_test.cpp.

#include <filesystem>

namespace carom::demos {

/// Throws InputError for an OFF or PLY file whose head claims more than the file can hold, or has no end;
/// other files pass.
void requireSoundHeader(const std::filesystem::path& path);

}  // namespace carom::demos
