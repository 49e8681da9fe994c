#pragma once
// PNG files through libpng; png.cpp is the only file that names it. Tested in tests/renderer/png_test.cpp.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image.h"
#include "renderer/raster.h"

namespace carom::renderer {

/// Images with a longer side are refused.
inline constexpr int kMaxPngSide = 16384;

/// (keyword, text) pairs for the file's text chunks.
using PngText = std::vector<std::pair<std::string, std::string>>;

/// What packs the quick files: quick_deflate.h where the build has it, else zlib.
enum class PngDeflate { kBest, kZlib };

/// The image as the bytes of a PNG file: 8-bit RGB, tagged sRGB, packed for speed rather than size. A keyword
/// is 1 to 79 ASCII characters; a text may be UTF-8.
std::vector<std::uint8_t> encodePng(const Image& image, const PngText& text = {},
                                    PngDeflate deflate = PngDeflate::kBest);

/// Encodes pictures one after the other, to the bytes of `encodePng`: bands of rows that are those of the
/// picture before are not packed again. Without a quick deflate all are.
class PngSequence {
 public:
  PngSequence();
  ~PngSequence();
  PngSequence(const PngSequence&) = delete;
  PngSequence& operator=(const PngSequence&) = delete;
  std::vector<std::uint8_t> encode(const Image& image, const PngText& text);

 private:
  struct Bands;
  std::unique_ptr<Bands> bands_;
};

enum class PngPacking { kSmall, kQuick };

/// The raster's own channels and bits, packed for size or for speed; tagged sRGB when it has 8 bits.
std::vector<std::uint8_t> encodePng(const Raster& raster, const PngText& text = {},
                                    PngPacking packing = PngPacking::kSmall,
                                    PngDeflate deflate = PngDeflate::kBest);

struct DecodedPng {
  Image image;
  PngText text;
};

/// Any PNG file as 8-bit RGB (alpha is dropped, 16 bits are scaled), and its text chunks in the file's order.
/// Throws InputError naming the file when it cannot be read, is no PNG, or is truncated.
DecodedPng readPng(const std::filesystem::path& path);

struct DecodedRaster {
  Raster raster;
  PngText text;
};

/// Any PNG file with the channels and bits it has; palettes become RGB, fewer than 8 bits become 8, a
/// transparent colour becomes an alpha channel. Throws as readPng does.
DecodedRaster readPngRaster(const std::filesystem::path& path);

}  // namespace carom::renderer
