#pragma once
// PNG files through libpng; png.cpp is the only file that names it. Tested in
// tests/renderer/image/png_test.cpp.

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/image/raster.h"

namespace carom::renderer {

/// Images with a longer side, or of more pixels, are refused by what their header says, before they are given
/// memory. 8K (7680 x 4320) fits. A pixel takes at most 8 bytes here (4 channels of 16 bits), and where two
/// images are compared and shown in a report at most 50.
inline constexpr int kMaxPngSide = 16384;
inline constexpr std::int64_t kMaxPngPixels = std::int64_t{1} << 25;

/// Files whose text chunks are longer in all are refused.
inline constexpr std::size_t kMaxPngTextBytes = std::size_t{1} << 20;

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
  /// By the last call of `encode`: bands that were packed, not kept.
  int packedBands() const;

 private:
  struct Bands;
  std::unique_ptr<Bands> bands_;
};

enum class PngPacking { kSmall, kQuick };

/// The raster's own channels and bits, packed for size or for speed; tagged sRGB when it has 8 bits.
std::vector<std::uint8_t> encodePng(const Raster& raster, const PngText& text = {},
                                    PngPacking packing = PngPacking::kSmall,
                                    PngDeflate deflate = PngDeflate::kBest);

/// The same image packed for size: every filter is tried.
std::vector<std::uint8_t> encodeSmallPng(const Image& image, const PngText& text = {});

/// What a PNG file is made of after its signature.
struct PngChunk {
  std::string kind;  ///< Four letters.
  std::vector<std::uint8_t> data;
};
/// The chunks of a file that was encoded here.
std::vector<PngChunk> pngChunks(const std::vector<std::uint8_t>& file);
void appendPngSignature(std::vector<std::uint8_t>& bytes);
void appendPngChunk(std::vector<std::uint8_t>& bytes, const PngChunk& chunk);

/// A zlib stream (RFC 1950), packed for size: what a PNG file's rows are in, and what browsers unpack.
std::vector<std::uint8_t> zlibStream(std::span<const std::uint8_t> bytes);

struct DecodedPng {
  Image image;
  PngText text;
};

/// Any PNG file as 8-bit RGB (alpha is dropped, 16 bits are scaled), and its text chunks in the file's order
/// but for packed ones, which encodePng does not write and which could become a thousand times as long.
/// Throws InputError naming the file when it cannot be read, is no PNG, is truncated, or is beyond the limits
/// above.
DecodedPng readPng(const std::filesystem::path& path);

struct DecodedRaster {
  Raster raster;
  PngText text;
};

/// Any PNG file with the channels and bits it has; palettes become RGB, fewer than 8 bits become 8, a
/// transparent colour becomes an alpha channel. Throws as readPng does.
DecodedRaster readPngRaster(const std::filesystem::path& path);
/// The same of a stream that can be read again from its beginning; `name` is for messages.
DecodedPng decodePng(std::istream& in, const std::string& name);
DecodedRaster decodePngRaster(std::istream& in, const std::string& name);

/// The text chunks alone, as readPngRaster gives them; the pixels are passed over, whole or not. Empty where
/// it cannot be read or is no PNG.
PngText readPngText(const std::filesystem::path& path);

/// How many pixels the file says it has; 0 where it cannot be read or is no PNG.
std::int64_t pngPixels(const std::filesystem::path& path);

}  // namespace carom::renderer
