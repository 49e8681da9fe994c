#include "demos/frame_stream.h"

#include <gtest/gtest.h>

#include "demos/exit_code.h"
#include "demos/frame_identity.h"

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

}  // namespace
}  // namespace carom::demos
