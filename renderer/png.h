#pragma once
// PNG files through libpng; png.cpp is the only file that names it. Tested in tests/renderer/png_test.cpp.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image.h"

namespace carom::renderer {

/// Images with a longer side are refused.
inline constexpr int kMaxPngSide = 16384;

/// (keyword, text) pairs for the file's text chunks.
using PngText = std::vector<std::pair<std::string, std::string>>;

/// The image as the bytes of a PNG file: 8-bit RGB, tagged sRGB, packed for speed rather than size. A keyword
/// is 1 to 79 ASCII characters; a text may be UTF-8.
std::vector<std::uint8_t> encodePng(const Image& image, const PngText& text = {});

struct DecodedPng {
  Image image;
  PngText text;
};

/// Any PNG file as 8-bit RGB (alpha is dropped, 16 bits are scaled), and its text chunks in the file's order.
/// Throws InputError naming the file when it cannot be read, is no PNG, or is truncated.
DecodedPng readPng(const std::filesystem::path& path);

}  // namespace carom::renderer
