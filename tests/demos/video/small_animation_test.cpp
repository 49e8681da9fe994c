// The file is an animated PNG whose frames, put over each other, are the pictures; it keeps to its size, and
// what is given up is given up in order.
#include "demos/video/small_animation.h"

#include <gtest/gtest.h>

#include <sstream>

#include "renderer/image/png.h"

namespace carom::demos {
namespace {

/// A square of 10 pixels that goes right over a background of few colours.
std::vector<renderer::Image> movingSquare(int count, int width = 96, int height = 54) {
  std::vector<renderer::Image> pictures;
  for (int i = 0; i < count; ++i) {
    renderer::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const bool inside = x >= 2 * i && x < 2 * i + 10 && y >= 20 && y < 30;
        const std::array<std::uint8_t, 3> background = {static_cast<std::uint8_t>(y < 20 ? 200 : 90), 120,
                                                        60};
        const std::array<std::uint8_t, 3> color =
            inside ? std::array<std::uint8_t, 3>{240, 16, 16} : background;
        image.rgb.insert(image.rgb.end(), color.begin(), color.end());
      }
    pictures.push_back(std::move(image));
  }
  return pictures;
}

std::uint32_t wordAt(const std::vector<std::uint8_t>& data, std::size_t at) {
  return std::uint32_t{data[at]} << 24 | std::uint32_t{data[at + 1]} << 16 |
         std::uint32_t{data[at + 2]} << 8 | data[at + 3];
}

/// The frames as a viewer shows them: each is made a PNG of its own and read by libpng.
std::vector<renderer::Image> shownFrames(const std::vector<std::uint8_t>& file) {
  std::vector<renderer::PngChunk> head;
  std::vector<renderer::Image> frames;
  renderer::Image screen;
  std::vector<std::uint8_t> control;
  for (const renderer::PngChunk& chunk : renderer::pngChunks(file)) {
    if (chunk.kind == "IHDR")
      screen = {static_cast<int>(wordAt(chunk.data, 0)), static_cast<int>(wordAt(chunk.data, 4)), {}};
    if (chunk.kind == "IHDR" || chunk.kind == "PLTE" || chunk.kind == "tRNS") head.push_back(chunk);
    if (chunk.kind == "fcTL") control = chunk.data;
    if (chunk.kind != "IDAT" && chunk.kind != "fdAT") continue;
    const bool is_first = chunk.kind == "IDAT";
    const auto width = static_cast<int>(wordAt(control, 4)), height = static_cast<int>(wordAt(control, 8));
    const auto left = static_cast<int>(wordAt(control, 12)), top = static_cast<int>(wordAt(control, 16));
    std::vector<std::uint8_t> bytes;
    renderer::appendPngSignature(bytes);
    for (renderer::PngChunk part : head) {
      if (part.kind == "IHDR")
        for (std::size_t i = 0; i < 8; ++i) part.data[i] = control[4 + i];
      renderer::appendPngChunk(bytes, part);
    }
    const auto skip = static_cast<std::ptrdiff_t>(is_first ? 0 : 4);
    renderer::appendPngChunk(bytes, {"IDAT", {chunk.data.begin() + skip, chunk.data.end()}});
    renderer::appendPngChunk(bytes, {"IEND", {}});
    std::istringstream in(std::string(bytes.begin(), bytes.end()));
    const renderer::Raster raster = renderer::decodePngRaster(in, "frame").raster;
    EXPECT_EQ(raster.channels, 4) << "a clear colour";
    if (is_first) screen.rgb.assign(3 * static_cast<std::size_t>(screen.width * screen.height), 0);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t from = 4 * static_cast<std::size_t>(y * width + x);
        if (raster.samples[from + 3] == 0) continue;
        const std::size_t to = 3 * static_cast<std::size_t>((top + y) * screen.width + left + x);
        for (std::size_t c = 0; c < 3; ++c)
          screen.rgb[to + c] = static_cast<std::uint8_t>(raster.samples[from + c]);
      }
    frames.push_back(screen);
  }
  return frames;
}

TEST(IndexedAnimation, ShowsThePicturesAsTheyAre) {
  const std::vector<renderer::Image> pictures = movingSquare(8);
  const std::vector<renderer::Image> shown = shownFrames(indexedAnimation(pictures, {1, 15}, {255, 0}));
  ASSERT_EQ(shown.size(), pictures.size());
  for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i].rgb, pictures[i].rgb) << "frame " << i;
}

TEST(IndexedAnimation, AFrameHoldsWhatChangedAlone) {
  std::size_t largest = 0;
  for (const renderer::PngChunk& chunk :
       renderer::pngChunks(indexedAnimation(movingSquare(8), {1, 15}, {255, 0})))
    if (chunk.kind == "fcTL" && wordAt(chunk.data, 0) > 0)
      largest = std::max<std::size_t>(largest, wordAt(chunk.data, 4) * wordAt(chunk.data, 8));
  EXPECT_EQ(largest, 12u * 10u);
}

TEST(IndexedAnimation, LeavesAloneWhatHasHardlyChanged) {
  std::vector<renderer::Image> pictures(2, renderer::Image{4, 4, std::vector<std::uint8_t>(48, 100)});
  for (std::uint8_t& channel : pictures[1].rgb) channel = 108;
  EXPECT_EQ(shownFrames(indexedAnimation(pictures, {1, 15}, {255, 8}))[1].rgb, pictures[0].rgb);
  EXPECT_EQ(shownFrames(indexedAnimation(pictures, {1, 15}, {255, 7}))[1].rgb, pictures[1].rgb);
}

TEST(SmallAnimation, KeepsToItsSizeAndIsBestWhereThereIsRoom) {
  const std::vector<renderer::Image> pictures = movingSquare(30, 192, 108);
  const SmallAnimation best = smallAnimation(pictures, 15.0, 300 * 1024);
  EXPECT_EQ(best.width, 192);
  EXPECT_EQ(best.fps, 15.0);
  EXPECT_EQ(shownFrames(best.moving).size(), 15u)
      << "every second of the pictures, which come at twice the rate";
  const SmallAnimation tight = smallAnimation(pictures, 15.0, best.moving.size() / 2);
  EXPECT_LE(tight.moving.size(), best.moving.size() / 2);
  EXPECT_LT(shownFrames(tight.moving).size() * static_cast<std::size_t>(tight.width), 15u * 192u);
  const std::vector<renderer::Image> still = shownFrames([&] {
    // A still has no fcTL: it is read as it is.
    std::vector<std::uint8_t> control(26, 0);
    std::vector<std::uint8_t> bytes;
    renderer::appendPngSignature(bytes);
    for (const renderer::PngChunk& chunk : renderer::pngChunks(best.still)) {
      if (chunk.kind == "IDAT") renderer::appendPngChunk(bytes, {"fcTL", control});
      if (chunk.kind == "IHDR") std::copy_n(chunk.data.begin(), 8, control.begin() + 4);
      renderer::appendPngChunk(bytes, chunk);
    }
    return bytes;
  }());
  EXPECT_EQ(still[0].rgb, pictures[0].rgb);
}

TEST(Smaller, KeepsTheMean) {
  const renderer::Image large = movingSquare(1, 100, 60)[0];
  const renderer::Image small = smaller(large, 50);
  EXPECT_EQ(small.width, 50);
  EXPECT_EQ(small.height, 30);
  const auto mean = [](const renderer::Image& image) {
    double sum = 0.0;
    for (const std::uint8_t channel : image.rgb) sum += channel;
    return sum / static_cast<double>(image.rgb.size());
  };
  EXPECT_NEAR(mean(small), mean(large), 0.5);
}

}  // namespace
}  // namespace carom::demos
