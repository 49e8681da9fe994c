#include "demos/frames/frame_names.h"

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

TEST(FrameNames, PadsTheNumberAsThePatternSays) {
  EXPECT_EQ(FrameNames("out/frame_%04d.png").file(7), "out/frame_0007.png");
  EXPECT_EQ(FrameNames("out/f####.png").file(12), "out/f0012.png");
  EXPECT_EQ(FrameNames("%d.png").file(12), "12.png");
  EXPECT_EQ(FrameNames("a#b.png").file(12345), "a12345b.png");
  EXPECT_EQ(FrameNames("/x/y/%03d.png").folder(), "/x/y");
  EXPECT_EQ(FrameNames("out/frame_%04d.png").file(7, "depth"), "out/frame_0007.depth.png");
  EXPECT_EQ(FrameNames::still("out/a.b.png").file(7), "out/a.b.png");
  EXPECT_EQ(FrameNames::still("out/still.png").file(0, "id"), "out/still.id.png");
}

TEST(FrameNames, RefusesPatternsWithoutExactlyOneNumber) {
  for (const char* pattern : {"frame.png", "%04d_%04d.png", "##a##.png", "frame_%04d.jpg", "frame_%04d",
                              "%s.png", "out/%04d/", "", "%%04d.png"})
    EXPECT_NE(thrownMessage<UsageError>([&] { FrameNames names(pattern); }).find("accepted: "),
              std::string::npos)
        << pattern;
}

}  // namespace
}  // namespace carom::demos
