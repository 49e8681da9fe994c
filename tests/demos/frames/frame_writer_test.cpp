#include "demos/frames/frame_writer.h"

#include <gtest/gtest.h>

#include "demos/format/content_hash.h"
#include "demos/system/exit_code.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {

renderer::Image stripes(int seed) {
  renderer::Image image{32, 18, std::vector<std::uint8_t>(32 * 18 * 3)};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>(i * 7 + static_cast<std::size_t>(seed) * 31);
  return image;
}

FrameToWrite frameToWrite(const std::filesystem::path& folder, int k) {
  FrameToWrite frame;
  frame.image = stripes(k);
  frame.path = folder / (std::to_string(k) + ".png");
  frame.record.frame = k;
  frame.text = {{"Frame", std::to_string(k)}};
  return frame;
}

TEST(FrameWriter, WritesEveryFrameInOrderAndPixelForPixel) {
  const TemporaryFolder folder;
  FrameWriter writer;
  for (int k = 0; k < 20; ++k) writer.submit(frameToWrite(folder.path(), k));
  const std::vector<FrameRecord> records = writer.finish();
  ASSERT_EQ(records.size(), 20u);
  for (int k = 0; k < 20; ++k) {
    const FrameRecord& record = records[static_cast<std::size_t>(k)];
    const renderer::DecodedPng png = renderer::readPng(folder.path() / (std::to_string(k) + ".png"));
    EXPECT_EQ(record.frame, k);
    EXPECT_EQ(png.image.rgb, stripes(k).rgb);
    EXPECT_EQ(png.text,
              (renderer::PngText{{"Frame", std::to_string(k)}, {"Pixels", hexText(record.pixel_hash)}}));
    EXPECT_EQ(record.pixel_hash, ContentHash().add(png.image.rgb.data(), png.image.rgb.size()).value());
  }
}

TEST(FrameWriter, TellsOfAFailureInsteadOfGoingOn) {
  const TemporaryFolder folder;
  const auto blocker = folder.file("plain", "");
  FrameWriter writer;
  EXPECT_THROW(
      {
        for (int k = 0; k < 100; ++k) writer.submit(frameToWrite(blocker, k));
        writer.finish();
      },
      CannotWrite);
  EXPECT_THROW(writer.finish(), CannotWrite);
}

}  // namespace
}  // namespace carom::demos
