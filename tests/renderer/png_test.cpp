#include "renderer/png.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

namespace fs = std::filesystem;

class PngFile : public testing::Test {
 protected:
  PngFile() : folder_(fs::temp_directory_path() / ("carom_png_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~PngFile() override { fs::remove_all(folder_); }

  fs::path write(const std::vector<std::uint8_t>& bytes) const {
    const fs::path path = folder_ / "image.png";
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
  }
  // What the refusal of the file says.
  static std::string refusal(const fs::path& path) {
    try {
      readPng(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

Image noise(int width, int height) {
  std::mt19937 random(3);
  Image image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    image.rgb.push_back(static_cast<std::uint8_t>(random() & 255u));
  return image;
}

// One row, one pixel, nothing, all and the size change in turn; the oracle packs each picture by itself.
TEST_F(PngFile, ASequenceHasTheBytesOfItsPicturesAlone) {
  PngSequence sequence;
  Image image = noise(60, 200);
  for (const int height : {200, 200, 137, 200, 64, 1}) {
    for (const int row : {0, 63, 64, 130, 199}) {
      image = noise(60, height);
      if (row < height) image.rgb[static_cast<std::size_t>(180 * row)] ^= 1;
      const std::vector<std::uint8_t> bytes = sequence.encode(image, {{"Row", std::to_string(row)}});
      EXPECT_EQ(bytes, encodePng(image, {{"Row", std::to_string(row)}})) << height << ", " << row;
      EXPECT_EQ(readPng(write(bytes)).image.rgb, image.rgb) << height << ", " << row;
      EXPECT_EQ(sequence.encode(image, {}), encodePng(image, {}));
    }
  }
}

TEST_F(PngFile, PixelsSurviveTheRoundTrip) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 1}, {1, 64}, {321, 181}}) {
    const Image image = noise(width, height);
    const DecodedPng decoded = readPng(write(encodePng(image)));
    EXPECT_EQ(decoded.image.width, width);
    EXPECT_EQ(decoded.image.height, height);
    EXPECT_EQ(decoded.image.rgb, image.rgb);
  }
}

/// What frames are like: flat stretches, slopes and edges; and more than one chunk's worth of it.
Image slopes(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int c : {x / 3 + y, (x * y) >> 6, x > y ? 200 : y * 7})
        image.rgb.push_back(static_cast<std::uint8_t>(c));
  return image;
}

// libpng inflates with zlib, so that each deflate is judged by another.
TEST_F(PngFile, EitherDeflateHoldsTheSamePixelsAndText) {
  const PngText text = {{"Software", "carom 0.1.0"}};
  for (const Image& image : {slopes(640, 360), noise(900, 700), slopes(1, 1), slopes(2, 300)}) {
    for (const PngDeflate deflate : {PngDeflate::kBest, PngDeflate::kZlib}) {
      const DecodedPng decoded = readPng(write(encodePng(image, text, deflate)));
      EXPECT_TRUE(decoded.image.rgb == image.rgb) << image.width << " x " << image.height;
      EXPECT_EQ(decoded.text, text);
    }
  }
}

TEST_F(PngFile, EitherDeflateHoldsTheSameSamplesOfARaster) {
  std::mt19937 random(5);
  for (int channels = 1; channels <= 4; ++channels)
    for (const int bits : {8, 16}) {
      Raster raster{57, 41, channels, bits, {}};
      for (int i = 0; i < 57 * 41 * channels; ++i)
        raster.samples.push_back(static_cast<std::uint16_t>(random() & ((1u << bits) - 1)));
      for (const PngDeflate deflate : {PngDeflate::kBest, PngDeflate::kZlib}) {
        const auto bytes = encodePng(raster, {}, PngPacking::kQuick, deflate);
        EXPECT_EQ(readPngRaster(write(bytes)).raster.samples, raster.samples) << channels << " x " << bits;
      }
    }
}

TEST_F(PngFile, TextSurvivesTheRoundTrip) {
  const PngText text = {
      {"Software", "carom 0.1.0"}, {"Scene", "Klötzchen auf Rampe"}, {"Empty", ""}, {"Scene", "twice"}};
  EXPECT_EQ(readPng(write(encodePng(noise(5, 4), text))).text, text);
}

TEST(Png, AsciiTextIsPlainAndOtherTextUnicode) {
  const auto holds = [](const std::vector<std::uint8_t>& bytes, const std::string& kind) {
    return std::search(bytes.begin(), bytes.end(), kind.begin(), kind.end()) != bytes.end();
  };
  EXPECT_TRUE(holds(encodePng(noise(1, 1), {{"Scene", "ramp"}}), "tEXtScene"));
  EXPECT_TRUE(holds(encodePng(noise(1, 1), {{"Scene", "Klötzchen"}}), "iTXtScene"));
}

TEST_F(PngFile, TheSameImageGivesTheSameBytes) {
  EXPECT_EQ(encodePng(noise(50, 40), {{"a", "b"}}), encodePng(noise(50, 40), {{"a", "b"}}));
}

TEST_F(PngFile, EveryTruncationIsRefused) {
  const std::vector<std::uint8_t> whole = encodePng(noise(20, 10), {{"Scene", "ramp"}});
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const fs::path path = write({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)});
    const std::string message = refusal(path);
    EXPECT_NE(message.find(path.string()), std::string::npos) << length << " of " << whole.size() << " bytes";
  }
}

TEST_F(PngFile, ADamagedByteIsRefused) {
  std::vector<std::uint8_t> bytes = encodePng(noise(20, 10));
  bytes[bytes.size() / 2] ^= 0x10;
  EXPECT_NE(refusal(write(bytes)).find("cannot decode PNG"), std::string::npos);
}

TEST_F(PngFile, AMissingFileAFolderAndATextFileAreRefusedInOneLine) {
  for (const fs::path& path :
       {folder_ / "nothing.png", folder_, write({'h', 'e', 'l', 'l', 'o', ' ', 'p', 'n', 'g'})}) {
    const std::string message = refusal(path);
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(PngFile, AShortFileThatClaimsALargeImageIsRefused) {
  std::vector<std::uint8_t> bytes = encodePng(noise(16384, 1));
  ASSERT_EQ(bytes[18], 0x40);  // IHDR: width 00 00 40 00 at 16, height at 20, checksum at 29.
  const std::vector<std::uint8_t> square = encodePng(noise(1, 1));
  bytes.resize(60);
  EXPECT_NE(refusal(write(bytes)), "");
}

TEST(Png, AnImageWithoutItsPixelsIsABug) {
  EXPECT_THROW(encodePng(Image{4, 4, std::vector<std::uint8_t>(47)}), ContractViolation);
  EXPECT_THROW(encodePng(Image{}), ContractViolation);
  EXPECT_THROW(encodePng(noise(2, 2), {{"", "no keyword"}}), ContractViolation);
  EXPECT_THROW(encodePng(noise(2, 2), {{std::string(80, 'k'), "too long"}}), ContractViolation);
}

}  // namespace
}  // namespace carom::renderer
