#pragma once
// JPEG files through libjpeg where the build has it; jpeg_picture.cpp is the only file that names it. Tested
// in tests/demos/asset/mesh_picture_test.cpp.

#include <cstdint>
#include <span>
#include <string>

#include "engine/solid/solid.h"

namespace carom::demos {

bool readsJpeg();
/// Throws InputError when the file is damaged, has more than 32 million pixels, or the build reads none.
SurfacePicture decodedJpeg(std::span<const std::uint8_t> file, const std::string& name);

}  // namespace carom::demos
