#include "renderer/image/grid_cover.h"

#include <random>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

TEST(GridCover, MarkedCellsAreCoveredOnceAndOthersNever) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    const int columns = 1 + static_cast<int>(random() % 9), rows = static_cast<int>(random() % 9);
    std::vector<std::uint8_t> marked(static_cast<std::size_t>(columns * rows));
    for (std::uint8_t& cell : marked) cell = random() % 3 == 0 ? 0 : 1;
    std::vector<std::uint8_t> covered(marked.size());
    for (const GridBlock& b : coverMarked(marked, columns))
      for (int y = b.y_begin; y < b.y_end; ++y)
        for (int x = b.x_begin; x < b.x_end; ++x) ++covered[static_cast<std::size_t>(y * columns + x)];
    EXPECT_EQ(covered, marked) << columns << "x" << rows;
  }
}

TEST(GridCover, ARectangleIsOneBlock) {
  const std::vector<std::uint8_t> marked = {0, 0, 0, 0,  //
                                            0, 1, 1, 0,  //
                                            0, 1, 1, 0};
  EXPECT_EQ(coverMarked(marked, 4), (std::vector<GridBlock>{{1, 3, 1, 3}}));
}

TEST(GridCover, BlocksThatTouchDoNotMeet) {
  const GridBlock block{2, 5, 1, 4};
  EXPECT_TRUE(block.meets({4, 9, 3, 9}));
  EXPECT_FALSE(block.meets({5, 9, 1, 4}));
  EXPECT_FALSE(block.meets({2, 5, 4, 9}));
  EXPECT_EQ(common(block, {4, 9, 0, 2}), (GridBlock{4, 5, 1, 2}));
  EXPECT_TRUE(common(block, {6, 9, 0, 2}).isEmpty());
  EXPECT_EQ(joined(block, {6, 9, 0, 2}), (GridBlock{2, 9, 0, 4}));
}

}  // namespace
}  // namespace carom::renderer
