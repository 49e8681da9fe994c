#include "renderer/image/cutout.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/image/color.h"
#include "renderer/image/edge_filter.h"

namespace carom::renderer {
namespace {

// A pixel that a body of this colour covers by half over nothing: half its light, which is what is undone.
TEST(Cutout, AColourDoesNotDependOnItsCoverage) {
  Image image{3, 1, {200, 100, 50, 0, 0, 0, 9, 9, 9}, {255, 128, 0}};
  const float half = 128.0f / 255.0f;
  for (std::size_t i = 0; i < 3; ++i) {
    const float light = half * linearLight(static_cast<float>(image.rgb[i]) / 255.0f);
    image.rgb[3 + i] =
        static_cast<std::uint8_t>(std::lround(255.0f * (1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f)));
  }
  unmultiply(image);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(image.rgb[3 + i], image.rgb[i], 1) << i;
    EXPECT_EQ(image.rgb[6 + i], 0);  // What nobody sees is black.
  }
}

TEST(Cutout, ChannelsComeBackFromARaster) {
  const Image image{2, 1, {1, 2, 3, 4, 5, 6}, {7, 8}};
  const Image back = imageOf(rasterOf(image));
  EXPECT_EQ(back.rgb, image.rgb);
  EXPECT_EQ(back.alpha, image.alpha);
}

// A slanted edge between a black body and nothing: no colour tells it, and the coverage of each column is the
// line's own, but for what a step of one pixel mixes across itself, an eighth of the rest.
TEST(Cutout, EdgesOfABlackBodyAreSmoothInItsAlpha) {
  constexpr int kWidth = 60, kHeight = 12;
  std::vector<std::uint8_t> rgba(4 * kWidth * kHeight, 0);
  const auto edge = [](int x) { return 3.0 + 0.1 * (x + 0.5); };  // Rows from the bottom that are covered.
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      rgba[4 * static_cast<std::size_t>(y * kWidth + x) + 3] = y + 0.5 < edge(x) ? 0 : 255;
  EdgeFilter filter(kWidth, kHeight);
  Image image;
  filter.apply(rgba, image);
  filter.applyToAlpha(rgba, image);
  for (int x = 10; x < kWidth - 10; ++x) {
    double covered = 0.0;
    for (int y = 0; y < kHeight; ++y)
      covered += image.alpha[static_cast<std::size_t>(y * kWidth + x)] / 255.0;
    EXPECT_NEAR(covered, edge(x), 0.08) << x;
  }
}

}  // namespace
}  // namespace carom::renderer
