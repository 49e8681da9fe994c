#include "demos/video/caption_painter.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

renderer::Image plain(int width, int height) {
  renderer::Image image{width, height, {}};
  image.rgb.assign(static_cast<std::size_t>(3 * width * height), 128);
  return image;
}

/// The rows that differ from a plain image: the first, the one after the last, and the most pixels in one.
struct Changed {
  int top = -1, bottom = -1, widest = 0, bright = 0;
};
Changed changedBy(const renderer::Image& image) {
  Changed changed;
  for (int y = 0; y < image.height; ++y) {
    int count = 0;
    for (int x = 0; x < image.width; ++x) {
      count += image.pixel(x, y)[0] != 128 ? 1 : 0;
      changed.bright += image.pixel(x, y)[0] > 180 ? 1 : 0;
    }
    if (count == 0) continue;
    if (changed.top < 0) changed.top = y;
    changed.bottom = y + 1;
    changed.widest = std::max(changed.widest, count);
  }
  return changed;
}

TEST(CaptionPainter, LeavesTheImageAsItIsWithoutALine) {
  EXPECT_EQ(withCaption(plain(320, 180), "").rgb, plain(320, 180).rgb);
  EXPECT_EQ(withCaption(plain(320, 180), "  ").rgb, plain(320, 180).rgb);
}

TEST(CaptionPainter, WritesOneBandNearTheLowerEdgeAtEverySize) {
  for (const auto& [width, height] : {std::pair{320, 180}, {640, 360}, {1280, 720}, {1920, 1080}}) {
    const Changed band = changedBy(withCaption(plain(width, height), "v = 1.25 m/s"));
    EXPECT_GT(band.top, height * 4 / 5) << height;
    EXPECT_LT(band.bottom, height) << height;
    EXPECT_LT(band.bottom - band.top, height / 9) << height;
    EXPECT_GT(band.bright, 40) << "letters are seen";
  }
}

TEST(CaptionPainter, BreaksALongLineInTwoAndStaysInsideTheImage) {
  const std::string line =
      "stop after v²/(2·5/7 g c/r): 6.16, 3.08, 1.54 m   gone: 0.00, 0.00, 0.00 m and more";
  const Changed one = changedBy(withCaption(plain(320, 180), "short"));
  const Changed two = changedBy(withCaption(plain(320, 180), line));
  EXPECT_GT(two.bottom - two.top, (one.bottom - one.top) * 3 / 2);
  EXPECT_LT(two.widest, 320);
  EXPECT_LT(changedBy(withCaption(plain(320, 180), std::string(300, 'x'))).widest, 320);
}

}  // namespace
}  // namespace carom::demos
