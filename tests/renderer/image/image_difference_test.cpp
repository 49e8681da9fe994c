// What differs between two images, against a plain second reckoning and against cases known in closed form.
#include "renderer/image/image_difference.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

Raster flat(int width, int height, int channels, int bits, std::uint16_t value) {
  const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height * channels);
  return {width, height, channels, bits, std::vector<std::uint16_t>(samples, value)};
}

std::uint16_t& sample(Raster& raster, int x, int y, int channel) {
  return raster.samples[static_cast<std::size_t>((y * raster.width + x) * raster.channels + channel)];
}

/// Random images that agree in most pixels, and differ here and there by a little or by much.
std::pair<Raster, Raster> randomPair(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&random](unsigned n) { return static_cast<int>(random() % n); };
  Raster a{1 + below(90), 1 + below(70), 1 + below(4), below(2) == 0 ? 8 : 16, {}};
  for (int i = 0; i < a.width * a.height * a.channels; ++i)
    a.samples.push_back(static_cast<std::uint16_t>(random() & static_cast<unsigned>(a.fullScale())));
  Raster b = a;
  for (int k = below(200); k > 0; --k) {
    std::uint16_t& s =
        sample(b, below(unsigned(b.width)), below(unsigned(b.height)), below(unsigned(b.channels)));
    const int step = below(2) == 0 ? below(6) : below(unsigned(b.fullScale()));
    s = static_cast<std::uint16_t>(std::min(b.fullScale(), s + step));
  }
  return {a, b};
}

struct Reckoned {
  int largest = 0;
  std::int64_t pixels_different = 0, pixels_beyond = 0;
  double mean = 0.0;
  std::map<std::pair<int, int>, std::int64_t> beyond_by_tile;
};

/// The same figures, from sample indices alone.
Reckoned reckoned(const Raster& a, const Raster& b, int tolerance) {
  Reckoned r;
  const int channels = a.channels;
  double sum = 0.0;
  for (int pixel = 0; pixel < a.width * a.height; ++pixel) {
    int most = 0;
    for (int i = pixel * channels; i < (pixel + 1) * channels; ++i) {
      const int step = std::abs(a.samples[std::size_t(i)] - b.samples[std::size_t(i)]);
      most = std::max(most, step);
      sum += step;
    }
    r.largest = std::max(r.largest, most);
    r.pixels_different += most > 0 ? 1 : 0;
    if (most <= tolerance) continue;
    ++r.pixels_beyond;
    ++r.beyond_by_tile[{pixel % a.width / kTileSide, pixel / a.width / kTileSide}];
  }
  r.mean = sum / static_cast<double>(a.samples.size());
  return r;
}

TEST(ImageDifference, AgreesWithAPlainReckoningOnRandomPairs) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const auto [a, b] = randomPair(seed);
    const ImageDifference d = differenceOf(a, b, 3);
    const Reckoned r = reckoned(a, b, 3);
    EXPECT_EQ(d.largest, r.largest);
    EXPECT_EQ(d.pixels_different, r.pixels_different);
    EXPECT_EQ(d.pixels_beyond, r.pixels_beyond);
    EXPECT_DOUBLE_EQ(d.mean, r.mean);
    std::int64_t most = 0;
    for (const auto& [tile, count] : r.beyond_by_tile) most = std::max(most, count);
    EXPECT_EQ(d.worst_tile.pixels_beyond, most);
  }
}

TEST(ImageDifference, SwappingTheImagesChangesNothing) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto [a, b] = randomPair(seed);
    const ImageDifference ab = differenceOf(a, b, 2), ba = differenceOf(b, a, 2);
    EXPECT_EQ(
        std::tuple(ab.largest, ab.largest_x, ab.largest_y, ab.largest_channel, ab.pixels_beyond, ab.mean),
        std::tuple(ba.largest, ba.largest_x, ba.largest_y, ba.largest_channel, ba.pixels_beyond, ba.mean));
    EXPECT_EQ(differenceImage(a, b, {2, 16}).rgb, differenceImage(b, a, {2, 16}).rgb);
  }
}

TEST(ImageDifference, NamesThePixelTheChannelAndTheTileOfASingleChange) {
  const Raster a = flat(100, 70, 3, 8, 40);
  Raster b = a;
  sample(b, 97, 65, 1) = 103;
  const ImageDifference d = differenceOf(a, b, 2);
  EXPECT_EQ(std::tuple(d.full_scale, d.largest, d.largest_x, d.largest_y), std::tuple(255, 63, 97, 65));
  EXPECT_EQ(d.largest_channel, "green");
  EXPECT_EQ(std::tuple(d.pixels_different, d.pixels_beyond), std::tuple(1, 1));
  EXPECT_DOUBLE_EQ(d.mean, 63.0 / (100 * 70 * 3));
  const Tile& t = d.worst_tile;  // the last, cut off at the right and the lower edge
  EXPECT_EQ(std::tuple(t.x, t.y, t.width, t.height, t.pixels_beyond), std::tuple(96, 64, 4, 6, 1));
}

TEST(ImageDifference, TheToleranceItselfPassesAndOneStepMoreDoesNot) {
  const Raster a = flat(5, 5, 1, 16, 30000);
  Raster b = a;
  sample(b, 2, 3, 0) = 30007;
  EXPECT_EQ(differenceOf(a, b, 7).pixels_beyond, 0);
  EXPECT_EQ(differenceOf(a, b, 6).pixels_beyond, 1);
  EXPECT_EQ(differenceOf(a, b, 6).full_scale, 65535);
}

TEST(ImageDifference, TheTileWithMorePixelsBeyondOutweighsTheOneWithALargerSum) {
  const Raster a = flat(64, 32, 1, 8, 0);
  Raster b = a;
  sample(b, 1, 1, 0) = 255;
  sample(b, 40, 1, 0) = sample(b, 41, 1, 0) = 9;
  EXPECT_EQ(differenceOf(a, b, 2).worst_tile.x, 32);
  EXPECT_EQ(differenceOf(a, b, 20).worst_tile.x, 0);
}

TEST(ImageDifference, ATransparentPixelDiffersInAlphaAlone) {
  const Raster opaque = flat(4, 4, 3, 8, 90);
  Raster clear = flat(4, 4, 4, 8, 90);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) sample(clear, x, y, 3) = 255;
  EXPECT_EQ(differenceOf(opaque, clear, 0).largest, 0);
  sample(clear, 3, 0, 3) = 200;
  const ImageDifference d = differenceOf(opaque, clear, 0);
  EXPECT_EQ(std::tuple(d.largest, d.largest_channel, d.largest_x), std::tuple(55, std::string("alpha"), 3));
}

TEST(ImageDifference, GreyEqualsRgbOfThreeEqualChannels) {
  const Raster grey = flat(3, 2, 1, 16, 777);
  Raster rgb = flat(3, 2, 3, 16, 777);
  EXPECT_TRUE(comparable(grey, rgb));
  EXPECT_EQ(differenceOf(grey, rgb, 0).largest, 0);
  sample(rgb, 1, 1, 2) = 778;
  EXPECT_EQ(differenceOf(grey, rgb, 0).largest_channel, "blue");
}

TEST(ImageDifference, OtherSizesOrBitsAreNotComparable) {
  const Raster a = flat(4, 3, 3, 8, 0);
  EXPECT_FALSE(comparable(a, flat(3, 4, 3, 8, 0)));
  EXPECT_FALSE(comparable(a, flat(4, 4, 3, 8, 0)));
  EXPECT_FALSE(comparable(a, flat(4, 3, 3, 16, 0)));
  EXPECT_THROW(differenceOf(a, flat(4, 4, 3, 8, 0), 0), ContractViolation);
  EXPECT_EQ(shapeText(flat(4, 3, 1, 16, 0).shape()), "4x3 16-bit grey");
}

TEST(DifferenceImage, IsTheAmplifiedStepOfEachChannelClamped) {
  Raster a = flat(3, 1, 3, 8, 0), b = a;
  sample(b, 0, 0, 0) = 2;    // within: 2 * 16
  sample(b, 1, 0, 1) = 200;  // clamped
  const Image image = differenceImage(a, b, {2, 16});
  EXPECT_EQ(image.rgb, (std::vector<std::uint8_t>{32, 0, 0, 0, 255, 0, 0, 0, 0}));
}

TEST(DifferenceImage, ShowsEveryPixelBeyondTheToleranceHoweverSmallItsStep) {
  const Raster a = flat(20, 20, 1, 16, 500);
  Raster b = a;
  sample(b, 7, 9, 0) = 501;  // the neighbour's id: 1/65535, far below one level of 8 bits
  const Image image = differenceImage(a, b, {0, 16});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) EXPECT_EQ(image.pixel(x, y)[0], x == 7 && y == 9 ? 85 : 0);
}

}  // namespace
}  // namespace carom::renderer
