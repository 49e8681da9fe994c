#include "renderer/mesh/picture_levels.h"

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

TEST(PictureLevels, GetSmallerByTheMeanOfTheirLight) {
  // Black and white side by side are, from afar, half of the light of white: 188 of 255, not 128.
  const SurfacePicture checker{2, 2, {0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0}};
  const PictureLevels levels = pictureLevels(checker, 2, 2);
  ASSERT_EQ(levels.levels.size(), 2u);
  EXPECT_EQ(levels.levels[0], checker);
  EXPECT_EQ(levels.levels[1], (SurfacePicture{1, 1, {188, 188, 188}}));
}

TEST(PictureLevels, KeepTheMeanWhateverTheSize) {
  const SurfacePicture red{3, 5, std::vector<std::uint8_t>(45, 77)};
  for (const SurfacePicture& level : pictureLevels(red, 8, 4).levels)
    for (const std::uint8_t byte : level.rgb) EXPECT_EQ(byte, 77);
}

TEST(LayerSize, IsThatOfTheLargestAndHasABound) {
  const auto sized = [](int width, int height) { return SurfacePicture{width, height, {}}; };
  const std::vector<SurfacePicture> few = {sized(100, 20), sized(30, 70)};
  EXPECT_EQ(layerSize(few).width, 128);
  EXPECT_EQ(layerSize(few).height, 128);
  const std::vector<SurfacePicture> many(64, sized(2048, 2048));
  const PictureSize bounded = layerSize(many);
  EXPECT_LE(4.0 * 64 * bounded.width * bounded.height, 0x1p27);
  EXPECT_EQ(bounded.width, 512);
  EXPECT_EQ(layerSize(many, {1024, std::size_t{1} << 40}).width, 1024);
}

}  // namespace
}  // namespace carom::renderer
