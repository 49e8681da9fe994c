#include "renderer/view/damage.h"

#include <random>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

bool covers(const std::vector<GridBlock>& blocks, int x, int y) {
  for (const GridBlock& b : blocks)
    if (b.meets({x, x + 1, y, y + 1})) return true;
  return false;
}

TEST(Damage, NoneIsNoBlock) {
  EXPECT_TRUE(Damage(640, 360).isEmpty());
  EXPECT_TRUE(Damage(640, 360).blocks().empty());
}

TEST(Damage, AllOfItIsTheWholeImage) {
  Damage damage(333, 111);
  damage.addAll();
  EXPECT_FALSE(damage.isEmpty());
  EXPECT_EQ(damage.blocks(), (std::vector<GridBlock>{{0, 333, 0, 111}}));
}

TEST(Damage, BlocksCoverWhatWasAddedStayInTheImageAndAreDisjoint) {
  std::mt19937 random(11);
  for (int round = 0; round < 100; ++round) {
    const int width = 1 + static_cast<int>(random() % 900), height = 1 + static_cast<int>(random() % 700);
    const auto within = [&](int size) { return static_cast<int>(random() % static_cast<unsigned>(size)); };
    Damage damage(width, height);
    std::vector<GridBlock> added;
    for (int i = 0; i < 1 + round % 20; ++i) {
      const int x = within(width), y = within(height);
      added.push_back({x, x + 1 + within(60), y, y + 1 + within(60)});
      damage.add(added.back());
    }
    const std::vector<GridBlock> blocks = damage.blocks();
    EXPECT_LE(blocks.size(), static_cast<std::size_t>(Damage::kMostBlocks));
    for (const GridBlock& b : added)
      for (const int x : {b.x_begin, std::min(b.x_end, width) - 1})
        for (const int y : {b.y_begin, std::min(b.y_end, height) - 1})
          EXPECT_TRUE(covers(blocks, x, y)) << width << "x" << height << ": " << x << "," << y;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      EXPECT_EQ(common(blocks[i], {0, width, 0, height}), blocks[i]);
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(blocks[i].meets(blocks[k]));
    }
  }
}

TEST(Damage, WhatIsOutsideOfTheImageOrHasNoPixelsDamagesNothing) {
  Damage damage(100, 100);
  for (const GridBlock& b :
       {GridBlock{-9, 0, 5, 9}, GridBlock{100, 120, 5, 9}, GridBlock{5, 9, -4, 0}, GridBlock{7, 7, 5, 9}})
    damage.add(b);
  EXPECT_TRUE(damage.isEmpty());
}

TEST(Damage, MoreThanMostOfTheImageIsAllOfIt) {
  Damage damage(10 * Damage::kTile, 10 * Damage::kTile);
  damage.add({0, 10 * Damage::kTile, 0, 6 * Damage::kTile});
  EXPECT_FALSE(damage.isWhole());
  damage.add({0, 1, 10 * Damage::kTile - 1, 10 * Damage::kTile});
  EXPECT_TRUE(damage.isWhole());
}

}  // namespace
}  // namespace carom::renderer
