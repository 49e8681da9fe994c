#include "demos/frames/frame_stream.h"

#include <gtest/gtest.h>

#include "demos/frames/frame_identity.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

TEST(FrameStream, EachFormatHoldsThePixelsAsItsDefinitionSays) {
  FrameToWrite frame;
  frame.image = {2, 1, {1, 2, 3, 250, 10, 0}};
  frame.text = {{"Frame", "0"}};
  EXPECT_EQ(streamedFrame(streamFormat("rgb24"), frame), frame.image.rgb);
  const std::vector<std::uint8_t> ppm = streamedFrame(streamFormat("ppm"), frame);
  EXPECT_EQ(std::string(ppm.begin(), ppm.end()), std::string("P6\n2 1\n255\n\x01\x02\x03\xfa\x0a\x00", 17));
  EXPECT_EQ(streamedFrame(streamFormat("png"), frame), encodedFrame(frame.image, frame.text).bytes);
  EXPECT_THROW(streamFormat("jpg"), UsageError);
}

TEST(FrameStream, OtherOutputsKeepTheirSixteenBits) {
  OutputToWrite grey, rgb;
  grey.raster = {2, 1, 1, 16, {0x1234, 65535}};
  grey.text = {{"Output", "depth"}};
  rgb.raster = {1, 1, 3, 16, {0x0102, 0x0304, 0x0506}};
  const auto text = [](const std::vector<std::uint8_t>& bytes) {
    return std::string(bytes.begin(), bytes.end());
  };
  EXPECT_EQ(text(streamedOutput(StreamFormat::kPpm, grey)), "P5\n2 1\n65535\n\x12\x34\xff\xff");
  EXPECT_EQ(text(streamedOutput(StreamFormat::kPpm, rgb)), "P6\n1 1\n65535\n\x01\x02\x03\x04\x05\x06");
  EXPECT_EQ(streamedOutput(StreamFormat::kPng, grey), encodedOutput(grey.raster, grey.text).bytes);
}

}  // namespace
}  // namespace carom::demos
