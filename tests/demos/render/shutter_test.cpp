#include "demos/render/shutter.h"

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

// Half of a frame in sixteen moments: thirty-two a frame, the last of which is the frame's own.
TEST(Shutter, IsOpenForItsShareOfAFrameUpToTheFramesTime) {
  const Shutter shutter(180.0, 16);
  ASSERT_TRUE(shutter.isOpen());
  EXPECT_EQ(shutter.perFrame(), 32);
  const std::vector<int> moments = shutter.moments(3);
  ASSERT_EQ(moments.size(), 16u);
  EXPECT_EQ(moments.front(), 81);
  EXPECT_EQ(moments.back(), 96);
}

TEST(Shutter, NothingIsShownFromBeforeTheStart) {
  for (const int moment : Shutter(360.0, 4).moments(0)) EXPECT_EQ(moment, 0);
}

TEST(Shutter, MomentsOfSuccessiveFramesDoNotGoBack) {
  const Shutter shutter(360.0, 16);
  EXPECT_EQ(shutter.perFrame(), 16);
  EXPECT_GT(shutter.moments(5).front(), shutter.moments(4).back());
}

TEST(Shutter, OneExposureHasNoTime) {
  EXPECT_FALSE(Shutter(180.0, 1).isOpen());
  EXPECT_FALSE(Shutter(0.0, 16).isOpen());
}

}  // namespace
}  // namespace carom::demos
