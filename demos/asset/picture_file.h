#pragma once
// The pictures that meshes are covered with: PNG, and JPEG where the build has a library for it; others are
// told. For the process that reads a mesh file, since pictures are strangers' too. Tested in
// tests/demos/asset/mesh_picture_test.cpp.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "engine/solid/solid.h"

namespace carom::demos {

/// Sides of a picture are halved until they are at most so long.
inline constexpr int kLongestPictureSide = 2048;

/// Throws InputError that says what it is when it is none of these, or is damaged or larger than 32 million
/// pixels.
SurfacePicture decodePicture(std::span<const std::uint8_t> file, const std::string& name);
SurfacePicture readPicture(const std::filesystem::path& path);

}  // namespace carom::demos
