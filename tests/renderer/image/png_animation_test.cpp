#include "renderer/image/png_animation.h"

#include <random>

#include <gtest/gtest.h>

#include "tests/renderer/image/apng_reader.h"

namespace carom::renderer {
namespace {

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    image.rgb.push_back(static_cast<std::uint8_t>(random() & 255u));
  return image;
}

// All changes, nothing does, one pixel in a corner, one inside, a column, all again.
TEST(PngAnimation, EveryPixelOfEveryFrameSurvivesAnIndependentReader) {
  std::vector<Image> frames{noise(53, 31, 1)};
  frames.push_back(frames.back());
  const auto change = [&frames](int x, int y) {
    const_cast<std::uint8_t*>(frames.back().pixel(x, y))[1] ^= 64;
  };
  for (const auto& [x, y] : {std::pair{52, 30}, {0, 0}, {20, 7}}) {
    frames.push_back(frames.back());
    change(x, y);
  }
  frames.push_back(frames.back());
  for (int y = 3; y < 29; ++y) change(17, y);
  frames.push_back(noise(53, 31, 2));
  PngAnimation animation(static_cast<int>(frames.size()), frameDelay(30.0), {{"Title", "of frames"}});
  std::vector<std::uint8_t> file;
  for (const Image& frame : frames) {
    const std::vector<std::uint8_t> bytes = animation.add(frame);
    file.insert(file.end(), bytes.begin(), bytes.end());
  }
  const Decoded read = decoded(file);
  ASSERT_EQ(read.frames.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(read.frames[i].rgb, frames[i].rgb) << i;
  EXPECT_EQ(read.delay.numerator, 1);
  EXPECT_EQ(read.delay.denominator, 30);
}

TEST(PngAnimation, AFrameIsShownForTheNearestFractionOfASecond) {
  const auto expectDelay = [](double fps, int numerator, int denominator) {
    EXPECT_EQ(frameDelay(fps).numerator, numerator) << fps;
    EXPECT_EQ(frameDelay(fps).denominator, denominator) << fps;
  };
  expectDelay(30.0, 1, 30);
  expectDelay(1000.0, 1, 1000);
  expectDelay(12.5, 2, 25);
  expectDelay(0.5, 2, 1);
  expectDelay(30000.0 / 1001.0, 1001, 30000);
  expectDelay(1e-9, 65535, 1);
}

}  // namespace
}  // namespace carom::renderer
