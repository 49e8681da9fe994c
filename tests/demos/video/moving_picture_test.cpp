// Moving pictures, stills and sheets by the name that -o gives, from outside.
#include <filesystem>

#include <gtest/gtest.h>

#include "demos/system/exit_code.h"
#include "demos/video/contact_sheet.h"
#include "renderer/image/png.h"
#include "tests/demos/support/program_run.h"
#include "tests/renderer/image/apng_reader.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

const std::vector<std::string> kShort{"render", "bouncing-ball", "--size", "96x54", "--duration", "0.4"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::uint8_t> bytesOf(const fs::path& path) {
  const std::string text = readTextFile(path);
  return {text.begin(), text.end()};
}

TEST(MovingPicture, AnAnimatedPngHoldsEveryPixelOfEveryFrame) {
  const TemporaryFolder folder;
  const fs::path clip = folder.path() / "clip.apng";
  const ProgramEnd end = runCarom(with(kShort, {"-o", clip.string(), "--fps", "20"}));
  ASSERT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.out.rfind(clip.string() + "  8 frames  ", 0), 0u) << end.out;
  const renderer::Decoded read = renderer::decoded(bytesOf(clip));
  std::string pixels;
  for (const renderer::Image& frame : read.frames) pixels.append(frame.rgb.begin(), frame.rgb.end());
  EXPECT_TRUE(pixels == runCarom(with(kShort, {"--fps", "20", "-o", "-", "--stream", "rgb24"})).out);
  EXPECT_EQ(read.delay.numerator, 1);
  EXPECT_EQ(read.delay.denominator, 20);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(MovingPicture, TheSameRunGivesTheSameBytesWithAnyNumberOfWorkers) {
  const TemporaryFolder folder;
  const fs::path a = folder.path() / "one" / "clip.apng", b = folder.path() / "two" / "clip.apng";
  runCarom(with(kShort, {"--workers", "1", "-o", a.string()}));
  runCarom(with(kShort, {"--workers", "2", "-o", b.string()}));
  const renderer::Decoded one = renderer::decoded(bytesOf(a)), two = renderer::decoded(bytesOf(b));
  ASSERT_EQ(one.frames.size(), 12u);
  ASSERT_EQ(two.frames.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(one.frames[i].rgb, two.frames[i].rgb) << i;
}

TEST(MovingPicture, AVideosNameNeedsFfmpegAndSaysWhatDoesNot) {
  const TemporaryFolder folder;
  for (const char* name : {"v.mp4", "v.gif", "v.webp", "v.webm"}) {
    const fs::path path = folder.path() / name;
    const ProgramEnd end = runCarom(with(kShort, {"-o", path.string()}), {"PATH=" + folder.path().string()});
    EXPECT_EQ(end.code, 4) << name;
    EXPECT_NE(end.err.find("needs the program ffmpeg, which is not installed"), std::string::npos) << end.err;
    EXPECT_NE(end.err.find(".apng needs none"), std::string::npos) << end.err;
    EXPECT_FALSE(fs::exists(path));
  }
}

TEST(MovingPicture, AVideosNameGivesFfmpegEveryPixelOfEveryFrame) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "bin");
  const fs::path ffmpeg =
      folder.file("bin/ffmpeg", "#!/bin/sh\nfor out in \"$@\"; do :; done\nexec cat > \"$out\"\n");
  fs::permissions(ffmpeg, fs::perms::owner_all);
  for (const char* name : {"v.mp4", "v.gif", "v.webp"}) {
    const fs::path video = folder.path() / name;
    const ProgramEnd end = runCarom(with(kShort, {"-q", "-o", video.string()}),
                                    {"PATH=" + ffmpeg.parent_path().string() + ":/usr/bin:/bin"});
    ASSERT_EQ(end.code, 0) << end.err;
    EXPECT_TRUE(readTextFile(video) == runCarom(with(kShort, {"-o", "-", "--stream", "rgb24"})).out) << name;
    EXPECT_EQ(end.out + end.err, "");
  }
}

TEST(MovingPicture, APictureWithoutANumberIsOneOfTheStart) {
  const TemporaryFolder folder;
  const fs::path still = folder.path() / "still.png", at = folder.path() / "at.png";
  ASSERT_EQ(runCarom(with({"render", "bouncing-ball", "--size", "96x54"}, {"-o", still.string()})).code, 0);
  ASSERT_EQ(
      runCarom(with({"render", "bouncing-ball", "--size", "96x54"}, {"--at", "0", "-o", at.string()})).code,
      0);
  EXPECT_EQ(renderer::readPng(still).image.rgb, renderer::readPng(at).image.rgb);
}

TEST(MovingPicture, QuietPrintsNothingAndOneFrameIsNoneOfMany) {
  const TemporaryFolder folder;
  const std::string frames = (folder.path() / "f_%04d.png").string();
  const ProgramEnd quiet = runCarom(with(kShort, {"-q", "--frames", "2", "-o", frames}));
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  const ProgramEnd told = runCarom(with(kShort, {"--frames", "2", "-o", frames}));
  EXPECT_NE(told.out.find("  1 frame  "), std::string::npos) << told.out;
}

TEST(ContactSheet, HasMomentsOfTheWholeRunSideBySide) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "sheet.png";
  const ProgramEnd end = runCarom(with(kShort, {"--sheet", "3x2", "-o", path.string()}));
  ASSERT_EQ(end.code, 0) << end.err;
  const renderer::Image sheet = renderer::readPng(path).image;
  constexpr int kGap = ContactSheet::kGap_px;
  ASSERT_EQ(sheet.width, 3 * 96 + 4 * kGap);
  ASSERT_EQ(sheet.height, 2 * 54 + 3 * kGap);
  const std::string all = runCarom(with(kShort, {"-o", "-", "--stream", "rgb24"})).out;
  const std::size_t frame_bytes = 96 * 54 * 3;
  const std::vector<int> frames = sheetFrames({3, 2}, static_cast<int>(all.size() / frame_bytes));
  for (int i = 0; i < 6; ++i) {
    // The lower half, where no time is written.
    const std::string frame =
        all.substr(frame_bytes * static_cast<std::size_t>(frames[static_cast<std::size_t>(i)]));
    for (int y = 27; y < 54; ++y) {
      const std::uint8_t* row = sheet.pixel(kGap + i % 3 * (96 + kGap), kGap + i / 3 * (54 + kGap) + y);
      EXPECT_EQ(std::string(row, row + 288), frame.substr(static_cast<std::size_t>(288 * y), 288))
          << i << ", " << y;
    }
  }
}

TEST(ContactSheet, ItsMomentsAreEvenlySpreadFromTheFirstFrameToTheLast) {
  EXPECT_EQ(sheetFrames({2, 2}, 10), (std::vector<int>{0, 3, 6, 9}));
  EXPECT_EQ(sheetFrames({3, 1}, 6), (std::vector<int>{0, 3, 5}));
  EXPECT_THROW(sheetFrames({3, 2}, 5), UsageError);
  for (const char* text : {"", "4", "4x", "0x3", "4x3x2", "1x1", "65x1"})
    EXPECT_THROW(readSheet(text), UsageError) << text;
}

}  // namespace
}  // namespace carom::demos
