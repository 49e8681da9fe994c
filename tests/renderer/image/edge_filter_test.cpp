#include "renderer/image/edge_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace carom::renderer {
namespace {

// A bottom-up RGBA picture from grey values by (x, y), y counted from the top.
std::vector<std::uint8_t> picture(int width, int height, const std::function<int(int, int)>& grey) {
  std::vector<std::uint8_t> rgba;
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x) {
      const auto g = static_cast<std::uint8_t>(grey(x, y));
      rgba.insert(rgba.end(), {g, g, g, 255});
    }
  return rgba;
}

Image filtered(int width, int height, const std::function<int(int, int)>& grey) {
  EdgeFilter filter(width, height);
  Image image;
  filter.apply(picture(width, height, grey), image);
  return image;
}

double linear(int s) {
  const double v = s / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// White above the line y = rise * x + 20, black below; coverage by 64 columns of exact heights.
double whiteShare(double rise, int x, int y) {
  double sum = 0.0;
  for (int i = 0; i < 64; ++i) sum += std::clamp(rise * (x + (i + 0.5) / 64.0) + 20.0 - y, 0.0, 1.0);
  return sum / 64.0;
}

// Mean error against the exact coverage over pixels that the line crosses.
double meanError(double rise, bool transposed, bool with_filter) {
  const auto grey = [&](int x, int y) {
    if (transposed) std::swap(x, y);
    return rise * (x + 0.5) + 20.0 > y + 0.5 ? 255 : 0;
  };
  const Image image = filtered(64, 64, grey);
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 8; x < 56; ++x) {
      const double share = whiteShare(rise, x, y);
      if (share <= 0.0 || share >= 1.0) continue;
      const int px = transposed ? y : x, py = transposed ? x : y;
      sum += std::abs(share - linear(with_filter ? *image.pixel(px, py) : grey(px, py)));
      ++count;
    }
  return sum / count;
}

TEST(EdgeFilter, ShallowEdgesComeCloseToTheirExactCoverage) {
  for (const double rise : {0.031, 0.061, 0.13})
    for (const bool transposed : {false, true})
      EXPECT_LT(meanError(rise, transposed, true), 0.06) << rise << (transposed ? " transposed" : "");
}

// The steeper, the shorter the stairs and the less they tell about the line. On the diagonal every step is
// one pixel, whatever the line's offset: the filter can only give the mean coverage, 3/4 and 1/4, from which
// the true ones deviate by 1/8 on average.
TEST(EdgeFilter, SteeperEdgesGainLessButGain) {
  for (const bool transposed : {false, true}) {
    EXPECT_LT(meanError(0.31, transposed, true), 0.4 * meanError(0.31, transposed, false));
    EXPECT_LT(meanError(0.62, transposed, true), 0.6 * meanError(0.62, transposed, false));
    EXPECT_LT(meanError(0.93, transposed, true), 0.125 + 0.01);
    EXPECT_LT(meanError(0.93, transposed, true), meanError(0.93, transposed, false));
  }
}

TEST(EdgeFilter, StraightEdgesAndFlatPartsStayAsTheyAre) {
  const auto grey = [](int x, int y) { return x < 10 ? 30 : y < 17 ? 200 : 90; };
  const Image image = filtered(33, 29, grey);
  for (int y = 0; y < 29; ++y)
    for (int x = 0; x < 33; ++x) {
      const bool at_crossing = std::abs(x - 10) < 13 && std::abs(y - 17) < 2;
      if (at_crossing) continue;
      EXPECT_EQ(*image.pixel(x, y), grey(x, y)) << x << "," << y;
    }
  const Image flat = filtered(33, 29, [](int, int) { return 77; });
  EXPECT_EQ(std::count(flat.rgb.begin(), flat.rgb.end(), 77), 3 * 33 * 29);
}

TEST(EdgeFilter, ShiftingThePictureShiftsTheResult) {
  const auto grey = [](int x, int y) { return (x - 0.13 * y > 20.0) != (y + 0.11 * x > 25.0) ? 230 : 25; };
  const Image here = filtered(64, 64, grey);
  for (int dx = 0; dx <= 4; dx += 2)
    for (int dy = 0; dy <= 8; dy += 4) {
      const Image there = filtered(64, 64, [&](int x, int y) { return grey(x - dx, y - dy); });
      for (int y = 8; y < 48; ++y)
        for (int x = 8; x < 52; ++x)
          EXPECT_EQ(*there.pixel(x + dx, y + dy), *here.pixel(x, y))
              << x << "," << y << " by " << dx << "," << dy;
    }
}

// Pixels are taken 32 and 64 at a time, what is left of a row one by one. Slanted stripes whose runs are
// shorter than the margin, and three greys, of which two differ by one more than the threshold.
TEST(EdgeFilter, EveryColumnIsTreatedAlike) {
  constexpr int kMargin = 24, kHeight = 60;
  const auto grey = [](int x, int y) {
    return std::array{60, 74, 200}[static_cast<std::size_t>((9 * x + 5 * y) / 61 % 3)];
  };
  const Image whole = filtered(300, kHeight, grey);
  int changed = 0;
  for (const int width : {97, 128, 129, 160, 191, 192, 193})
    for (const int begin : {0, 1, 31, 32, 33, 63, 64, 65}) {
      const Image part = filtered(width, kHeight, [&](int x, int y) { return grey(x + begin, y); });
      for (int y = kMargin; y < kHeight - kMargin; ++y)
        for (int x = kMargin; x < width - kMargin; ++x) {
          ASSERT_EQ(*part.pixel(x, y), *whole.pixel(x + begin, y))
              << x << "," << y << " from " << begin << " of " << width;
          if (*part.pixel(x, y) != grey(x + begin, y)) ++changed;
        }
    }
  EXPECT_GT(changed, 1000);
}

// A step within the outermost row or column: white there up to kEnd, black elsewhere. The line through it
// enters that row at kEnd / 2 and gives (2k + 1) / 2 kEnd of the k-th pixel from there to black.
TEST(EdgeFilter, EdgesAlongTheBorderAreSmoothedToo) {
  constexpr int kEnd = 12, kHeight = 40;
  constexpr double kBytes = 0.006;  // of linear light: half a step of the bytes near white, and of 12 bits
  const auto isOutermost = [](int side, int x, int y, int width) {
    return std::array{x == 0, x == width - 1, y == 0, y == kHeight - 1}[static_cast<std::size_t>(side)];
  };
  for (const int width : {33, 64, 65, 97, 128})
    for (int side = 0; side < 4; ++side) {
      const bool upright = side < 2;
      const Image image = filtered(width, kHeight, [&](int x, int y) {
        return isOutermost(side, x, y, width) && (upright ? y : x) < kEnd ? 255 : 0;
      });
      const int across = side % 2 == 0 ? 0 : (upright ? width : kHeight) - 1;
      for (int k = 0; k < kEnd / 2 - 1; ++k) {  // the last one is smoothed along the step's end as well
        const int along = kEnd / 2 + k;
        const int x = upright ? across : along, y = upright ? along : across;
        EXPECT_NEAR(linear(*image.pixel(x, y)), 1.0 - (2 * k + 1) / (2.0 * kEnd), kBytes)
            << x << "," << y << " of " << width;
      }
    }
}

TEST(EdgeFilter, RowsComeOutFromTopToBottom) {
  const Image image = filtered(5, 4, [](int x, int y) { return 3 * (5 * y + x); });
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(*image.pixel(x, y), 3 * (5 * y + x));
}

TEST(EdgeFilter, TinyImagesPass) {
  for (const int width : {1, 2, 3, 9})
    for (const int height : {1, 2, 3, 9}) {
      const Image image = filtered(width, height, [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; });
      EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * width * height));
    }
}

TEST(EdgeFilter, TheSamePictureGivesTheSameBytes) {
  const auto grey = [](int x, int y) { return (x * x + 3 * y * y) % 997 < 400 ? 210 : 40; };
  EXPECT_EQ(filtered(120, 90, grey).rgb, filtered(120, 90, grey).rgb);
}

// Blocks of few greys one over the other, so that runs are long and cross the changes; a few single pixels.
class Patchwork {
 public:
  Patchwork(int width, int height, unsigned seed)
      : rgba(4 * static_cast<std::size_t>(width * height)), width_(width), height_(height), random_(seed) {}

  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  GridBlock someBlock(int most) {
    const int x = below(width_), y = below(height_), widest = below(2) == 0 ? 2 : most;
    return {x, std::min(x + 1 + below(widest), width_), y, std::min(y + 1 + below(most), height_)};
  }
  void paint(const GridBlock& block, int grey) {
    for (int y = block.y_begin; y < block.y_end; ++y)
      for (int x = block.x_begin; x < block.x_end; ++x)
        for (int c = 0; c < 4; ++c)
          rgba[4 * static_cast<std::size_t>(y * width_ + x) + static_cast<std::size_t>(c)] =
              static_cast<std::uint8_t>(c == 3 ? 255 : grey);
  }

  std::vector<std::uint8_t> rgba;

 private:
  int width_, height_;
  std::mt19937 random_;
};

TEST(EdgeFilter, FilteredAgainWhereItChangedAPictureIsAsIfFilteredAtOnce) {
  for (const auto& [width, height] : {std::pair{150, 90}, {63, 200}, {64, 64}, {5, 4}, {1, 7}, {200, 1}}) {
    Patchwork picture(width, height, 17);
    EdgeFilter lasting(width, height), fresh(width, height);
    Image image, expected;
    picture.paint({0, width, 0, height}, 90);
    for (int i = 0; i < 60; ++i) picture.paint(picture.someBlock(width), 60 * picture.below(4));
    lasting.apply(picture.rgba, image);
    for (int round = 0; round < 60; ++round) {
      std::vector<GridBlock> blocks;
      for (int i = picture.below(4); i > 0; --i) {
        blocks.push_back(picture.someBlock(20));
        for (int k = picture.below(5); k > 0; --k)
          picture.paint(common(picture.someBlock(30), blocks.back()), 60 * picture.below(4));
      }
      lasting.applyAgain(picture.rgba, blocks, image);
      fresh.apply(picture.rgba, expected);
      ASSERT_EQ(image.rgb, expected.rgb) << width << "x" << height << ", round " << round;
    }
  }
}

}  // namespace
}  // namespace carom::renderer
