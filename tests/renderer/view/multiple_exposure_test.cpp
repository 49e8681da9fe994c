#include "renderer/view/multiple_exposure.h"

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

Image grey(std::uint8_t value) {
  return {1, 1, {value, value, value}};
}
int meanOf(const std::vector<std::uint8_t>& values) {
  MultipleExposure exposure;
  for (const std::uint8_t value : values) exposure.add(grey(value));
  Image image = grey(0);
  exposure.develop(image);
  return image.rgb[1];
}

TEST(MultipleExposure, EqualExposuresAreThePicture) {
  for (int value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    EXPECT_EQ(meanOf({byte, byte, byte, byte}), value);
  }
}

// Half the light of white is sRGB 188 (IEC 61966-2-1), a quarter 137.
TEST(MultipleExposure, MixesLightNotBytes) {
  EXPECT_EQ(meanOf({0, 255}), 188);
  EXPECT_EQ(meanOf({255, 0, 0, 0}), 137);
  EXPECT_EQ(meanOf({0, 255, 0, 0}), 137);
}

TEST(MultipleExposure, StartsAfreshAfterEachPicture) {
  MultipleExposure exposure;
  Image image = grey(0);
  exposure.add(grey(255));
  exposure.develop(image);
  EXPECT_EQ(image.rgb[0], 255);
  exposure.add(grey(10));
  exposure.develop(image);
  EXPECT_EQ(image.rgb[0], 10);
}

}  // namespace
}  // namespace carom::renderer
