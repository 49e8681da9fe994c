#include "demos/format/printable.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace carom::demos {
namespace {

TEST(Printable, PlainTextOfAnyScriptStaysAsItIs) {
  EXPECT_EQ(printable(""), "");
  EXPECT_EQ(printable("crate[7] \\ \"Kugel\" \xc3\xb6 \xe2\x82\xac \xf0\x9f\x8e\xb1"),
            "crate[7] \\ \"Kugel\" \xc3\xb6 \xe2\x82\xac \xf0\x9f\x8e\xb1");
}

TEST(Printable, ControlCharactersAreWrittenOut) {
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("\x1b[2J\x7f"), "\\x1b[2J\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "the one-byte CSI of an 8-bit terminal";
  EXPECT_EQ(printable("\xe2\x80\xa8"), "\\xe2\\x80\\xa8") << "a line separator";
}

TEST(Printable, BytesThatAreNoUtf8AreWrittenOut) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut off";
  EXPECT_EQ(printable("\xc0\x8a"), "\\xc0\\x8a") << "a line break in two bytes";
  EXPECT_EQ(printable("\xe0\x80\x8a"), "\\xe0\\x80\\x8a");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a surrogate pair";
}

TEST(Printable, OfWhatIsTooLongTheEndsAreKept) {
  for (const std::size_t size : {3000u, 5000u, 7999u, 8000u, 8001u, 3000000u}) {
    const std::string text = "begin" + std::string(size - 8, 'x') + "end";
    const std::string line = printable(text);
    EXPECT_LE(line.size(), kLongestLine);
    EXPECT_EQ(line == text, size <= kLongestLine) << size;
    EXPECT_EQ(line.substr(0, 5) + line.substr(line.size() - 3), "beginend");
  }
  const std::string breaks = printable(std::string(100000, '\n'));
  EXPECT_LE(breaks.size(), kLongestLine);
  EXPECT_EQ(breaks.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace carom::demos
