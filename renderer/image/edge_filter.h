#pragma once
// Morphological anti-aliasing (Reshetov 2009) on the CPU: finds the stairs that a slanted edge makes on the
// pixel grid, lays the straight line through them that made them, and mixes the two sides by the area the
// line cuts off. Mixing is done in linear light. Tested in tests/renderer/image/edge_filter_test.cpp.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "renderer/image/grid_cover.h"
#include "renderer/image/image.h"

namespace carom::renderer {

class EdgeFilter {
 public:
  EdgeFilter(int width, int height);

  /// Filters `rgba` (width * height * 4 bytes, rows from bottom to top, as GL delivers them) into the colours
  /// of an image with rows from top to bottom. Where the fourth bytes differ there is an edge, too.
  void apply(const std::vector<std::uint8_t>& rgba, Image& image);

  /// After `apply`: the fourth bytes, which tell how much of what lies behind shows, as the image's alpha
  /// along the same edges.
  void applyToAlpha(const std::vector<std::uint8_t>& rgba, Image& image);

  /// The same where `image` holds what the last call made and `rgba` has changed within `blocks` (rows
  /// counted from the bottom) only.
  void applyAgain(const std::vector<std::uint8_t>& rgba, std::span<const GridBlock> blocks, Image& image);

 private:
  using Bits = std::uint64_t;  // Of 64 neighbouring pixels, the leftmost lowest.

  // Of the image's pixels, rows counted from the top.
  struct Window {
    int left = 0, right = 0, top = 0, bottom = 0;
    bool hasRow(int y) const { return top <= y && y < bottom; }
    bool hasColumn(int x) const { return left <= x && x < right; }
  };

  void check(const std::vector<std::uint8_t>& rgba) const;
  void filter(const std::uint8_t* rgba, const Window& window, Image& image);
  void takeRow(const std::uint8_t* rgba, int y, const Window& window, Image& image) const;
  void markRow(const std::uint8_t* rgba, int y);
  void mixRowPair(const std::uint8_t* rgba, int y, const Window& window, Image& image) const;
  void mixColumnPairs(const std::uint8_t* rgba, const Window& window, Image& image);
  Window reached(const Window& changed) const;
  bool isMarked(const std::vector<Bits>& bits, int x, int y) const;
  std::size_t wordAt(int y) const { return static_cast<std::size_t>(y) * words_; }

  int width_;
  int height_;
  std::size_t words_;  // A row's; one more than it needs, zero, where runs end at the latest.
  std::vector<Bits> below_,
      right_;                // Where a pixel differs from the one below, and from the one to the right.
  std::vector<int> begins_;  // By column: where the run that is open begins.
  bool even_ = false;        // Bytes are taken for light itself, not for sRGB.
  std::vector<std::pair<int, int>> open_;  // End and column of the runs that go on below a window.
};

}  // namespace carom::renderer
