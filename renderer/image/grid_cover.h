#pragma once
// Marked cells of a grid as few rectangles: runs along the rows, joined with the same run of the row before.
// Tested in tests/renderer/image/grid_cover_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

namespace carom::renderer {

/// Cells [x_begin, x_end) by [y_begin, y_end); of an image's pixels, rows are counted from the bottom, as GL
/// does.
struct GridBlock {
  int x_begin = 0, x_end = 0, y_begin = 0, y_end = 0;

  bool isEmpty() const { return x_begin >= x_end || y_begin >= y_end; }
  bool meets(const GridBlock& other) const {
    return x_begin < other.x_end && other.x_begin < x_end && y_begin < other.y_end && other.y_begin < y_end;
  }
  std::int64_t area() const { return std::int64_t{x_end - x_begin} * (y_end - y_begin); }
  bool operator==(const GridBlock&) const = default;
};

/// What both cover.
GridBlock common(const GridBlock& a, const GridBlock& b);
/// The smallest that covers both.
GridBlock joined(const GridBlock& a, const GridBlock& b);

/// Disjoint blocks that cover exactly the marked of `columns` cells a row, row by row.
std::vector<GridBlock> coverMarked(std::span<const std::uint8_t> marked, int columns);

}  // namespace carom::renderer
