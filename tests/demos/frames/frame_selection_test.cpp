#include "demos/frames/frame_selection.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {

using Frames = std::vector<int>;

TEST(FrameSelection, RangesStepsAndSingleFramesAreAscendingAndOnce) {
  EXPECT_EQ(selectedFrames("0-3,7,20-30x5", 31), (Frames{0, 1, 2, 3, 7, 20, 25, 30}));
  EXPECT_EQ(selectedFrames("20-29x5", 31), (Frames{20, 25}));
  EXPECT_EQ(selectedFrames("9,2-4,3,2", 10), (Frames{2, 3, 4, 9}));
  EXPECT_EQ(selectedFrames("", 3), (Frames{0, 1, 2}));
  EXPECT_EQ(selectedFrames("0-5x999999999", 6), (Frames{0}));
}

TEST(FrameSelection, EverythingElseIsRefusedWithTheFramesThereAre) {
  for (const char* text :
       {"3-1", "10", "0-10", "a", "-1", "1,,2", "1,", ",", "0-4x0", "1 ", "4x2", "99999999999"}) {
    const std::string message = thrownMessage<UsageError>([&] { selectedFrames(text, 10); });
    EXPECT_NE(message.find(std::string("--frames ").append(text).append(": ")), std::string::npos) << message;
    EXPECT_NE(message.find("accepted: frames of 0 to 9"), std::string::npos) << message;
  }
}

TEST(FrameSelection, ShardsAreDisjointEvenAndCoverTheSelection) {
  const Frames all = selectedFrames("0-99,150,200-300x5", 301);
  for (const int count : {1, 2, 7, 8, 200}) {
    Frames together;
    for (int index = 1; index <= count; ++index) {
      const Frames mine = shardOf(all, {index, count});
      EXPECT_TRUE(std::is_sorted(mine.begin(), mine.end()));
      EXPECT_LE(mine.size(), all.size() / static_cast<std::size_t>(count) + 1);
      together.insert(together.end(), mine.begin(), mine.end());
    }
    std::sort(together.begin(), together.end());
    EXPECT_EQ(together, all) << count;
  }
}

TEST(FrameSelection, OnlyShardsOneToNAreAccepted) {
  EXPECT_EQ(readShard("3/8").index, 3);
  EXPECT_EQ(readShard("3/8").count, 8);
  EXPECT_EQ(readShard("").count, 1);
  for (const char* text : {"0/8", "9/8", "1/0", "1", "1/8/2", "-1/8", "a/b", "1 /8"})
    EXPECT_NE(thrownMessage<UsageError>([&] { readShard(text); }).find("accepted: i/n"), std::string::npos)
        << text;
}

TEST(FrameSelection, PartsThatCanRunAtOnceHaveManifestsOfTheirOwn) {
  EXPECT_EQ(manifestName("", ""), "manifest.json");
  EXPECT_EQ(manifestName("", "3/8"), "manifest.shard-3-of-8.json");
  EXPECT_EQ(manifestName("0-9", "01/2"), "manifest.frames-0-9.shard-1-of-2.json");
  std::string many = "0";
  for (int k = 1; k < 500; ++k) many.append(",").append(std::to_string(k));
  EXPECT_LT(manifestName(many, "").size(), 60u);
  EXPECT_NE(manifestName(many, ""), manifestName(many + ",500", ""));
}

}  // namespace
}  // namespace carom::demos
