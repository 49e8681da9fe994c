#pragma once
// The part of an image that has to be drawn again, as in a window system's damage regions: rounded out to
// tiles, and handed out as a few rectangles. Tested in tests/renderer/view/damage_test.cpp.

#include <cstdint>
#include <vector>

#include "renderer/image/grid_cover.h"

namespace carom::renderer {

class Damage {
 public:
  static constexpr int kTile = 16;           ///< Pixels along either side of a tile.
  static constexpr double kMostShare = 0.6;  ///< Of the tiles; where more are damaged, the whole image is.
  static constexpr int kMostBlocks = 4;      ///< Handed out: each costs draw calls of its own.

  /// No damage of an image of that size.
  Damage(int width, int height);

  /// Damages those pixels, as far as they are in the image.
  void add(const GridBlock& pixels);
  void addAll() { whole_ = true; }

  bool isEmpty() const { return !whole_ && marked_tiles_ == 0; }
  /// Whether all of the image is damaged: no more has to be added.
  bool isWhole() const { return whole_; }
  /// Disjoint rectangles within the image that cover all that was added.
  std::vector<GridBlock> blocks() const;

 private:
  GridBlock image_;
  int columns_;
  std::vector<std::uint8_t> marked_;  // By tile.
  std::size_t marked_tiles_ = 0;
  bool whole_ = false;
};

}  // namespace carom::renderer
