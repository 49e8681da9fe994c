#include "demos/format/progress.h"

#include <algorithm>
#include <sstream>

#include <gtest/gtest.h>

#include "demos/format/json.h"

namespace carom::demos {
namespace {

/// 300 frames at a steady 60 a second, on a clock of our own.
std::string progressOf(ProgressStyle style) {
  std::ostringstream out;
  double now_s = 100.0;
  {
    Progress progress({"frame", 300}, style, out, [&now_s] { return now_s; });
    for (int frame = 1; frame <= 300; ++frame) {
      now_s = 100.0 + frame / 60.0;
      progress.done(frame);
    }
  }
  return out.str();
}

TEST(Progress, WritesOneLineASecondWhereNobodyWatches) {
  const std::string text = progressOf(ProgressStyle::kLines);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
  EXPECT_NE(text.find("frame 120/300  40 %  60.0 fps  eta 3 s\n"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, RedrawsInPlaceOnATerminalAndCleansUp) {
  const std::string text = progressOf(ProgressStyle::kTerminal);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_GE(std::count(text.begin(), text.end(), '\r'), 40);
  EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
}

TEST(Progress, SpeaksJsonToPrograms) {
  std::istringstream lines(progressOf(ProgressStyle::kJson));
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const Json json = Json::parse(line, "line");
  EXPECT_EQ(json.at("frame").asNumber(), 60.0);
  EXPECT_EQ(json.at("total").asNumber(), 300.0);
  EXPECT_NEAR(json.at("perSecond").asNumber(), 60.0, 1e-9);
  EXPECT_NEAR(json.at("eta_s").asNumber(), 4.0, 1e-9);
}

TEST(Progress, SaysNothingWhenAskedTo) {
  EXPECT_EQ(progressOf(ProgressStyle::kNone), "");
}

}  // namespace
}  // namespace carom::demos
