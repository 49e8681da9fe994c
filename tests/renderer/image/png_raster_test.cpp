// PNG files with the channels and bits they have: what depth and id images need.
#include "renderer/image/png.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/foundation/contract.h"
#include "tests/support/temporary_folder.h"

namespace carom::renderer {
namespace {

namespace fs = std::filesystem;

class PngRaster : public testing::Test {
 protected:
  fs::path write(const std::vector<std::uint8_t>& bytes) const {
    return folder_.file("raster.png", {bytes.begin(), bytes.end()});
  }

  TemporaryFolder folder_;
};

Raster noise(int width, int height, int channels, int bits) {
  std::mt19937 random(11);
  Raster raster{width, height, channels, bits, {}};
  for (int i = 0; i < width * height * channels; ++i)
    raster.samples.push_back(
        static_cast<std::uint16_t>(random() & static_cast<unsigned>(raster.fullScale())));
  return raster;
}

TEST_F(PngRaster, EveryChannelAndBitSurvivesTheRoundTrip) {
  for (const int channels : {1, 2, 3, 4})
    for (const int bits : {8, 16})
      for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {65, 33}}) {
        const Raster raster = noise(width, height, channels, bits);
        const Raster read = readPngRaster(write(encodePng(raster))).raster;
        EXPECT_EQ(std::tuple(read.width, read.height, read.channels, read.bits),
                  std::tuple(width, height, channels, bits));
        EXPECT_EQ(read.samples, raster.samples) << channels << " channels of " << bits << " bits";
      }
}

TEST_F(PngRaster, NeighbouringSixteenBitValuesStayApart) {
  const Raster read = readPngRaster(write(encodePng(Raster{3, 1, 1, 16, {258, 259, 513}}))).raster;
  EXPECT_EQ(read.samples, (std::vector<std::uint16_t>{258, 259, 513}));  // 0x0102, 0x0103, 0x0201: byte order
}

TEST_F(PngRaster, AFrameReadsAsItsOwnBytesAndKeepsItsText) {
  const Image image{2, 1, {1, 2, 3, 250, 251, 252}};
  const DecodedRaster read = readPngRaster(write(encodePng(image, {{"State", "ab12"}})));
  EXPECT_EQ(read.raster.samples, (std::vector<std::uint16_t>{1, 2, 3, 250, 251, 252}));
  EXPECT_EQ(read.raster.channels, 3);
  EXPECT_EQ(read.text, (PngText{{"State", "ab12"}}));
}

TEST_F(PngRaster, EveryTruncationOfASixteenBitFileIsRefused) {
  const std::vector<std::uint8_t> whole = encodePng(noise(9, 8, 1, 16));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_THROW(readPngRaster(write({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)})),
                 InputError)
        << length << " of " << whole.size() << " bytes";
}

TEST(Png, ARasterThatCannotBeIsABug) {
  EXPECT_THROW(encodePng(Raster{2, 2, 5, 8, std::vector<std::uint16_t>(20)}), ContractViolation);
  EXPECT_THROW(encodePng(Raster{2, 2, 1, 4, std::vector<std::uint16_t>(4)}), ContractViolation);
  EXPECT_THROW(encodePng(Raster{2, 2, 1, 8, std::vector<std::uint16_t>(3)}), ContractViolation);
}

}  // namespace
}  // namespace carom::renderer
