#pragma once
// A palette for a few pictures of the same thing: median cut (Heckbert, Color Image Quantization for Frame
// Buffer Display, SIGGRAPH 1982) over colours of six bits a channel, so that equal pixels of two pictures are
// equal entries. Deterministic. Tested in tests/demos/video/palette_test.cpp.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/image/image.h"

namespace carom::demos {

using ByteColor = std::array<std::uint8_t, 3>;

class Palette {
 public:
  /// At most `most` colours, 2 to 256; fewer where the pictures have fewer.
  Palette(std::span<const renderer::Image> pictures, int most);

  const std::vector<ByteColor>& colors() const { return colors_; }
  /// The entry for a colour that one of the pictures has.
  std::uint8_t entryOf(const std::uint8_t* rgb) const { return entries_[cellOf(rgb)]; }

 private:
  static constexpr int kBits = 6;
  static constexpr std::size_t kCells = std::size_t{1} << (3 * kBits);
  static std::size_t cellOf(const std::uint8_t* rgb) {
    constexpr int kDropped = 8 - kBits;
    return (std::size_t{rgb[0]} >> kDropped) << (2 * kBits) | (std::size_t{rgb[1]} >> kDropped) << kBits |
           std::size_t{rgb[2]} >> kDropped;
  }

  std::vector<ByteColor> colors_;
  std::vector<std::uint8_t> entries_;  // of each cell
};

}  // namespace carom::demos
