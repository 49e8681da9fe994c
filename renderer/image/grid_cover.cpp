#include "renderer/image/grid_cover.h"

#include <algorithm>
#include <cstddef>

namespace carom::renderer {

GridBlock common(const GridBlock& a, const GridBlock& b) {
  return {std::max(a.x_begin, b.x_begin), std::min(a.x_end, b.x_end), std::max(a.y_begin, b.y_begin),
          std::min(a.y_end, b.y_end)};
}

GridBlock joined(const GridBlock& a, const GridBlock& b) {
  return {std::min(a.x_begin, b.x_begin), std::max(a.x_end, b.x_end), std::min(a.y_begin, b.y_begin),
          std::max(a.y_end, b.y_end)};
}

std::vector<GridBlock> coverMarked(std::span<const std::uint8_t> marked, int columns) {
  std::vector<GridBlock> blocks;
  const int rows = columns > 0 ? static_cast<int>(marked.size()) / columns : 0;
  std::size_t before = 0;  // Where those begin that end at this row.
  for (int y = 0; y < rows; ++y) {
    const std::size_t row = blocks.size();
    std::vector<GridBlock> runs;
    for (int x = 0; x < columns; ++x) {
      if (marked[static_cast<std::size_t>(y * columns + x)] == 0) continue;
      if (runs.empty() || runs.back().x_end != x) runs.push_back({x, x, y, y + 1});
      runs.back().x_end = x + 1;
    }
    for (GridBlock& run : runs)
      for (std::size_t i = before; i < row; ++i)
        if (blocks[i].y_end == y && blocks[i].x_begin == run.x_begin && blocks[i].x_end == run.x_end) {
          run.y_begin = blocks[i].y_begin;
          blocks[i].y_end = blocks[i].y_begin;  // Empty: the joined one stands for it.
        }
    before = row;
    blocks.insert(blocks.end(), runs.begin(), runs.end());
  }
  std::erase_if(blocks, [](const GridBlock& b) { return b.y_end == b.y_begin; });
  return blocks;
}

}  // namespace carom::renderer
