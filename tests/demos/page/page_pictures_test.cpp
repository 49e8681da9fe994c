// Pictures of bodies as a page holds them, read by rules of the format alone.
#include "demos/page/page_pictures.h"

#include <gtest/gtest.h>

#include "tests/demos/support/whole_reader.h"

namespace carom::demos {
namespace {

struct ReadPictures {
  std::int64_t layers = 0, width = 0, height = 0;
  std::vector<int> rgb;
};

ReadPictures readPictures(const PagePictures& pictures) {
  ByteStream out;
  pictures.write(out);
  WholeReader reader(out.bytes());
  ReadPictures read;
  read.layers = reader.whole();
  if (read.layers > 0) {
    read.width = reader.whole();
    read.height = reader.whole();
  }
  const auto row = static_cast<std::size_t>(3 * read.width);
  for (std::size_t i = 0; i < row * static_cast<std::size_t>(read.height * read.layers); ++i) {
    const bool has_left = i % row >= 3, has_above = i >= row;
    const int a = has_left ? read.rgb[i - 3] : 0, b = has_above ? read.rgb[i - row] : 0;
    const int c = has_left && has_above ? read.rgb[i - row - 3] : 0;
    const int guess = c >= std::max(a, b) ? std::min(a, b) : c <= std::min(a, b) ? std::max(a, b) : a + b - c;
    read.rgb.push_back((guess + reader.byte()) % 256);
  }
  EXPECT_TRUE(reader.atEnd());
  return read;
}

SurfacePicture noisy(int width, int height, unsigned seed) {
  SurfacePicture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    seed = 1664525u * seed + 1013904223u;
    picture.rgb.push_back(static_cast<std::uint8_t>(seed >> 24));
  }
  return picture;
}

TEST(PagePictures, OfOneSizeAreThereToTheLastBit) {
  PagePictures pictures;
  const SurfacePicture one = noisy(16, 8, 1), other = noisy(16, 8, 2);
  EXPECT_EQ(pictures.add(one), 0);
  EXPECT_EQ(pictures.add(other), 1);
  EXPECT_EQ(pictures.add(one), 0);
  const ReadPictures read = readPictures(pictures);
  EXPECT_EQ(read.layers, 2);
  EXPECT_EQ(read.width, 16);
  EXPECT_EQ(read.height, 8);
  std::vector<int> both(one.rgb.begin(), one.rgb.end());
  both.insert(both.end(), other.rgb.begin(), other.rgb.end());
  EXPECT_EQ(read.rgb, both);
}

TEST(PagePictures, GetTheSizeOfTheRenderersLayersWithinABound) {
  PagePictures pictures;
  pictures.add({3, 5, std::vector<std::uint8_t>(45, 77)});
  pictures.add({20, 1, std::vector<std::uint8_t>(60, 99)});
  const ReadPictures read = readPictures(pictures);
  EXPECT_EQ(read.width, 32);
  EXPECT_EQ(read.height, 8);
  for (std::size_t i = 0; i < read.rgb.size(); ++i) ASSERT_EQ(read.rgb[i], i < 3 * 32 * 8 ? 77 : 99);
  PagePictures large;
  large.add({4000, 2, std::vector<std::uint8_t>(24000, 5)});
  EXPECT_EQ(readPictures(large).width, 1024);
}

TEST(PagePictures, AreNoneOrAsManyAsEveryBrowserTakes) {
  PagePictures pictures;
  EXPECT_EQ(readPictures(pictures).layers, 0);
  for (int i = 0; i < PagePictures::kMostLayers; ++i)
    EXPECT_EQ(pictures.add({1, 1, {static_cast<std::uint8_t>(i), 0, 0}}), i);
  EXPECT_EQ(pictures.add({1, 1, {0, 1, 0}}), -1);
  EXPECT_EQ(pictures.add({1, 1, {9, 0, 0}}), 9);
}

}  // namespace
}  // namespace carom::demos
