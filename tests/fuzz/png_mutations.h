#pragma once
// Random PNG files, whole ones and damaged ones, for the reader: every colour type, depth and interlacing,
// with palettes, transparency, texts and profiles; then bytes, chunks and header fields are changed, mostly
// with sums that are right again, so that what lies behind them is reached. One seed, one file, everywhere.

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/foundation/contract.h"
#include "renderer/image/png.h"

namespace carom::renderer {

class PngMutations {
 public:
  explicit PngMutations(std::uint64_t seed) : random_(seed) {}

  /// A file that is whole.
  std::string whole() { return joined(chunks()); }

  /// A file with one to four changes.
  std::string damaged() {
    std::vector<Chunk> parts = chunks();
    for (std::uint64_t i = below(3); i > 0; --i) changeChunks(parts);
    std::string bytes = joined(parts);
    if (chance(2)) return bytes;
    for (std::uint64_t i = 1 + below(2); i > 0; --i) changeBytes(bytes);
    return bytes;
  }

 private:
  struct Chunk {
    std::string kind;
    std::string data;
    bool right_sum = true;
    std::int64_t extra_length = 0;  ///< That the chunk claims beyond its data.
  };

  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  bool chance(std::uint64_t one_in) { return below(one_in) == 0; }
  char byte() { return static_cast<char>(below(256)); }
  std::string noise(std::uint64_t size) {
    std::string bytes;
    for (std::uint64_t i = 0; i < size; ++i) bytes += byte();
    return bytes;
  }
  static std::string word(std::uint64_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  }

  /// CRC-32 (PNG 1.2, appendix 15).
  static std::uint32_t sumOf(const std::string& bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const char c : bytes) {
      sum ^= static_cast<std::uint8_t>(c);
      for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1u ? 0xedb88320u : 0u);
    }
    return ~sum;
  }

  /// A zlib stream (RFC 1950) of blocks that are stored as they are.
  std::string zlib(const std::string& bytes) {
    std::string stream = "\x78\x01";
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
      a = (a + static_cast<std::uint8_t>(c)) % 65521;
      b = (b + a) % 65521;
    }
    std::size_t at = 0;
    do {
      const std::size_t size = std::min<std::size_t>(bytes.size() - at, 1 + below(600));
      stream += at + size == bytes.size() ? '\1' : '\0';
      for (const std::size_t field : {size, ~size}) {
        stream += static_cast<char>(field & 255);
        stream += static_cast<char>(field >> 8 & 255);
      }
      stream += bytes.substr(at, size);
      at += size;
    } while (at < bytes.size());
    return stream + word(std::uint64_t{b} << 16 | a);
  }

  /// The rows of one pass, each after the byte that names its filter.
  std::string rows(std::uint64_t width, std::uint64_t height, std::uint64_t pixel_bits) {
    std::string bytes;
    if (width == 0) return bytes;
    for (std::uint64_t y = 0; y < height; ++y) {
      bytes += static_cast<char>(below(5));
      bytes += noise((width * pixel_bits + 7) / 8);
    }
    return bytes;
  }

  std::vector<Chunk> chunks() {
    struct Kind {
      int color, bits, channels;
    };
    constexpr std::array<Kind, 15> kKinds = {{{0, 1, 1},
                                              {0, 2, 1},
                                              {0, 4, 1},
                                              {0, 8, 1},
                                              {0, 16, 1},
                                              {2, 8, 3},
                                              {2, 16, 3},
                                              {3, 1, 1},
                                              {3, 2, 1},
                                              {3, 4, 1},
                                              {3, 8, 1},
                                              {4, 8, 2},
                                              {4, 16, 2},
                                              {6, 8, 4},
                                              {6, 16, 4}}};
    const Kind kind = kKinds[below(kKinds.size())];
    const std::uint64_t width = 1 + below(20), height = 1 + below(20);
    const bool interlaced = chance(2);
    std::vector<Chunk> parts = {{"IHDR", word(width) + word(height)}};
    for (const int field : {kind.bits, kind.color, 0, 0, static_cast<int>(interlaced)})
      parts[0].data += static_cast<char>(field);
    if (chance(3)) parts.push_back(spare());
    const std::uint64_t colors = std::uint64_t{1} << std::min(kind.bits, 8);
    if (kind.color == 3) parts.push_back({"PLTE", noise(3 * colors)});
    if (kind.color < 4 && chance(3))
      parts.push_back({"tRNS", noise(kind.color == 3 ? 1 + below(colors) : kind.color == 2 ? 6 : 2)});
    const auto pixel_bits = static_cast<std::uint64_t>(kind.bits * kind.channels);
    std::string pixels;
    if (interlaced) {
      // Adam7 (PNG 1.2, section 2.6): where each pass begins, and how far apart its pixels are.
      struct Pass {
        std::uint64_t x, y, dx, dy;
      };
      for (const Pass& pass : {Pass{0, 0, 8, 8}, Pass{4, 0, 8, 8}, Pass{0, 4, 4, 8}, Pass{2, 0, 4, 4},
                               Pass{0, 2, 2, 4}, Pass{1, 0, 2, 2}, Pass{0, 1, 1, 2}})
        pixels += rows((width + pass.dx - 1 - pass.x) / pass.dx, (height + pass.dy - 1 - pass.y) / pass.dy,
                       pixel_bits);
    } else {
      pixels = rows(width, height, pixel_bits);
    }
    const std::string stream = zlib(pixels);
    const std::size_t cut = below(stream.size());
    parts.push_back({"IDAT", stream.substr(0, cut)});
    parts.push_back({"IDAT", stream.substr(cut)});
    if (chance(3)) parts.push_back(spare());
    parts.push_back({"IEND", ""});
    return parts;
  }

  /// A chunk of which no pixel depends.
  Chunk spare() {
    const std::string key = "Scene" + std::string(1, '\0');
    switch (below(7)) {
      case 0:
        return {"tEXt", key + noise(below(40))};
      case 1:
        return {"zTXt", key + std::string(1, '\0') + zlib(noise(below(400)))};
      case 2:
        return {"iTXt", key + std::string(4, '\0') + noise(below(40))};
      case 3:
        return {"iTXt", key + '\1' + std::string(3, '\0') + zlib(noise(below(400)))};
      case 4:
        return {"iCCP", key + std::string(1, '\0') + zlib(noise(below(400)))};
      case 5:
        return {"gAMA", word(below(200000))};
      default:
        return {"abCd", noise(below(30))};
    }
  }

  void changeChunks(std::vector<Chunk>& parts) {
    const std::size_t at = below(parts.size());
    Chunk& chunk = parts[at];
    switch (below(9)) {
      case 0:
        if (!chunk.data.empty()) chunk.data[below(chunk.data.size())] = byte();
        break;
      case 1:
        chunk.data.resize(below(chunk.data.size() + 1));
        break;
      case 2:
        chunk.data += noise(below(50));
        break;
      case 3:
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(at));
        if (parts.empty()) parts.push_back({"IEND", ""});
        break;
      case 4:
        parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(at), Chunk(parts[below(parts.size())]));
        break;
      case 5:
        std::swap(chunk, parts[below(parts.size())]);
        break;
      case 6:
        chunk.right_sum = false;
        break;
      case 7:
        chunk.extra_length = static_cast<std::int64_t>(chance(2) ? below(100) : below(0xffffffff));
        break;
      default:
        // A field of the header, or what pretends to be another kind.
        if (chance(2) && parts[0].data.size() == 13) {
          const std::size_t field = below(13);
          parts[0].data[field] = chance(2) ? static_cast<char>(below(9)) : byte();
        } else {
          chunk.kind = parts[below(parts.size())].kind;
        }
    }
  }

  void changeBytes(std::string& bytes) {
    if (bytes.empty()) return;
    switch (below(3)) {
      case 0:
        bytes[below(bytes.size())] = byte();
        break;
      case 1:
        bytes.resize(below(bytes.size()));
        break;
      default:
        bytes.insert(below(bytes.size()), bytes.substr(below(bytes.size()), below(60)));
    }
  }

  static std::string joined(const std::vector<Chunk>& parts) {
    std::string bytes = "\x89PNG\r\n\x1a\n";
    for (const Chunk& chunk : parts) {
      const std::string body = chunk.kind + chunk.data;
      bytes += word(chunk.data.size() + static_cast<std::uint64_t>(chunk.extra_length)) + body +
               word(sumOf(body) ^ (chunk.right_sum ? 0u : 1u));
    }
    return bytes;
  }

  std::mt19937_64 random_;
};

/// What became of a file: it has an image that agrees with itself, or one line says why not. Anything else is
/// thrown as a logic error.
enum class PngFate { kDecoded, kRefused };
inline PngFate fateOf(const std::string& bytes) {
  try {
    std::istringstream in(bytes);
    const Raster raster = decodePngRaster(in, "file.png").raster;
    const auto samples = static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height) *
                         static_cast<std::size_t>(raster.channels);
    const bool fits = raster.width > 0 && raster.height > 0 && raster.samples.size() == samples &&
                      (raster.bits == 8 || raster.bits == 16) &&
                      std::all_of(raster.samples.begin(), raster.samples.end(),
                                  [&](std::uint16_t sample) { return sample <= raster.fullScale(); });
    std::istringstream again(bytes);
    const Image image = decodePng(again, "file.png").image;
    const bool agrees = image.width == raster.width && image.height == raster.height &&
                        3 * samples == image.rgb.size() * static_cast<std::size_t>(raster.channels);
    if (!fits || !agrees) throw std::logic_error("an image that does not agree with itself");
    return PngFate::kDecoded;
  } catch (const InputError& error) {
    const std::string line = error.what();
    if (line.find('\n') != std::string::npos || line.find("file.png") == std::string::npos)
      throw std::logic_error("no line about the file: " + line);
    return PngFate::kRefused;
  }
}

}  // namespace carom::renderer
