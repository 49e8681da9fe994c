// Few colours are kept as they are; of many the palette keeps within its number, deterministic, and a rare
// colour of its own is not lost.
#include "demos/video/palette.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace carom::demos {
namespace {

renderer::Image painted(int width, int height, const auto& colorAt) {
  renderer::Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int channel : colorAt(x, y)) image.rgb.push_back(static_cast<std::uint8_t>(channel));
  return image;
}

using Rgb = std::array<int, 3>;

TEST(Palette, KeepsFewColoursAsTheyAre) {
  const std::array<renderer::Image, 1> pictures = {painted(8, 8, [](int x, int) {
    return x < 3 ? Rgb{250, 10, 20} : x < 6 ? Rgb{0, 100, 200} : Rgb{77, 77, 77};
  })};
  const Palette palette(pictures, 16);
  ASSERT_EQ(palette.colors().size(), 3u);
  for (std::size_t i = 0; i < pictures[0].rgb.size(); i += 3) {
    const ByteColor& color = palette.colors()[palette.entryOf(&pictures[0].rgb[i])];
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(color[c], pictures[0].rgb[i + c]);
  }
}

TEST(Palette, OfASmoothPictureIsNearEverywhereAndKeepsARareColour) {
  const std::array<renderer::Image, 1> pictures = {painted(256, 128, [](int x, int y) {
    return x < 4 && y < 4 ? Rgb{255, 0, 255} : Rgb{x, 2 * y, 128};
  })};
  const Palette palette(pictures, 128);
  EXPECT_EQ(palette.colors().size(), 128u);
  int farthest = 0;
  for (std::size_t i = 0; i < pictures[0].rgb.size(); i += 3) {
    const ByteColor& color = palette.colors()[palette.entryOf(&pictures[0].rgb[i])];
    for (std::size_t c = 0; c < 3; ++c)
      farthest = std::max(farthest, std::abs(int{color[c]} - int{pictures[0].rgb[i + c]}));
  }
  // 256 x 256 values in 128 boxes, of cells of 4 x 4: at best 23 a side, half of it from the mean.
  EXPECT_LE(farthest, 32);
  const std::uint8_t magenta[3] = {255, 0, 255};
  const ByteColor& rare = palette.colors()[palette.entryOf(magenta)];
  EXPECT_EQ(rare, (ByteColor{255, 0, 255}));
  const Palette again(pictures, 128);
  EXPECT_EQ(again.colors(), palette.colors());
}

}  // namespace
}  // namespace carom::demos
