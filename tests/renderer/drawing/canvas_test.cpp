#include "renderer/drawing/canvas.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

constexpr Color kWhite = {1.0f, 1.0f, 1.0f}, kBlack = {0.0f, 0.0f, 0.0f};

int red(const Image& image, int x, int y) {
  return image.pixel(x, y)[0];
}

TEST(Canvas, StartsAsTheImageAndEndsAsIt) {
  Image image{7, 5, {}};
  for (int i = 0; i < 7 * 5 * 3; ++i) image.rgb.push_back(static_cast<std::uint8_t>(17 * i));
  const Image copy = Canvas(image).image();
  EXPECT_EQ(copy.width, 7);
  EXPECT_EQ(copy.height, 5);
  EXPECT_EQ(copy.rgb, image.rgb);
}

TEST(Canvas, AnAreaCoversPixelsByTheirShare) {
  Canvas canvas(20, 20, kWhite);
  const std::array<Vec2, 4> square = {Vec2(4.0, 5.0), Vec2(10.5, 5.0), Vec2(10.5, 15.25), Vec2(4.0, 15.25)};
  canvas.fill(square, {kBlack, 0.8});
  const Image image = canvas.image();
  EXPECT_NEAR(red(image, 7, 9), 255 * 0.2, 1.5);
  EXPECT_NEAR(red(image, 10, 9), 255 * (1.0 - 0.5 * 0.8), 6.0) << "half covered";
  EXPECT_NEAR(red(image, 7, 15), 255 * (1.0 - 0.25 * 0.8), 6.0) << "a quarter";
  EXPECT_EQ(red(image, 3, 9), 255);
  EXPECT_EQ(red(image, 11, 9), 255);
}

TEST(Canvas, AShareOfAnAreaCountsInItsPixel) {
  Canvas canvas(20, 20, kWhite);
  const std::array<Vec2, 4> all = {Vec2(-5.0, -5.0), Vec2(40.0, -5.0), Vec2(40.0, 40.0), Vec2(-5.0, 40.0)};
  canvas.fill(all, {kBlack}, [](int x, int y) { return x == 13 && y == 6 ? 1.0 : x < 10 ? 0.5 : 0.0; });
  const Image image = canvas.image();
  EXPECT_EQ(red(image, 13, 6), 0);
  EXPECT_NEAR(red(image, 4, 6), 127.5, 1.5);
  EXPECT_EQ(red(image, 13, 7), 255);
}

TEST(Canvas, ALineIsAsWideAsAskedAndItsHaloWiderAndWhite) {
  Canvas canvas(40, 40, {0.5f, 0.5f, 0.5f});
  const std::array<Vec2, 2> ends = {Vec2(5.0, 20.0), Vec2(35.0, 20.0)};
  canvas.line(ends, {{kBlack}, 4.0, 0.0, 1.0});
  const Image image = canvas.image();
  for (int y : {18, 19, 20, 21}) EXPECT_EQ(red(image, 20, y), 0) << y;
  EXPECT_EQ(red(image, 20, 17), 255);
  EXPECT_EQ(red(image, 20, 22), 255);
  EXPECT_NEAR(red(image, 20, 15), 128, 1);
}

TEST(Canvas, DashesLeaveGaps) {
  Canvas canvas(100, 20, kWhite);
  const std::array<Vec2, 2> ends = {Vec2(0.0, 10.0), Vec2(100.0, 10.0)};
  canvas.line(ends, {{kBlack}, 2.0, 6.0});
  const Image image = canvas.image();
  int inked = 0;
  for (int x = 0; x < 100; ++x) inked += red(image, x, 10) < 64;
  // Dashes and gaps of 6, and the round ends turn 2 of a gap of 8 into ink.
  EXPECT_NEAR(inked, 100.0 * 8.0 / 14.0, 8.0);
}

TEST(Canvas, TextStandsWhereItIsAlignedAndIsTheSameTwice) {
  const auto written = [](Align align) {
    Canvas canvas(200, 40, kWhite);
    canvas.text({100.0, 20.0}, "ε₁ = H", {20.0, {kBlack}, align});
    return canvas.image();
  };
  const Image image = written(Align::kLeft);
  EXPECT_EQ(image.rgb, written(Align::kLeft).rgb);
  const auto extent = [](const Image& of) {
    std::array<int, 4> box = {of.width, of.height, -1, -1};
    for (int y = 0; y < of.height; ++y)
      for (int x = 0; x < of.width; ++x)
        if (red(of, x, y) < 128)
          box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
    return box;
  };
  const double width = Canvas(8, 8, kWhite).textWidth("ε₁ = H", {20.0, {kBlack}});
  const std::array<int, 4> left = extent(image), right = extent(written(Align::kRight)),
                           middle = extent(written(Align::kMiddle));
  EXPECT_NEAR(left[0], 100.0, 3.0);
  EXPECT_NEAR(left[2], 100.0 + width, 4.0);
  EXPECT_NEAR(right[2], 100.0, 4.0);
  EXPECT_NEAR(0.5 * (middle[0] + middle[2]), 100.0, 3.0);
  EXPECT_LT(left[1], 20);
  EXPECT_GT(left[3], 20);
}

TEST(Canvas, CapitalsStandCentredOnTheHeightAskedFor) {
  Canvas canvas(60, 60, kWhite);
  canvas.text({10.0, 30.0}, "H", {30.0, {kBlack}});
  const Image image = canvas.image();
  int top = 60, bottom = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      if (red(image, x, y) < 128) {
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
  EXPECT_NEAR(0.5 * (top + bottom + 1), 30.0, 1.0);
  EXPECT_NEAR(bottom + 1 - top, 0.73 * 30.0, 1.5) << "of DejaVu Sans: another font stood in";
}

}  // namespace
}  // namespace carom::renderer
