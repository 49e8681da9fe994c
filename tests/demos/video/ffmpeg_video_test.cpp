// With a script that stands in for ffmpeg: what reaches its input, and what becomes of its end.
#include "demos/video/ffmpeg_video.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/system/exit_code.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// A folder first on the PATH, with an ffmpeg that runs `script`; its last argument is $out.
class StandIn {
 public:
  explicit StandIn(const std::string& script) : old_path_(std::getenv("PATH")) {
    const fs::path program =
        folder_.file("ffmpeg", "#!/bin/sh\nfor out in \"$@\"; do :; done\n" + script + "\n");
    fs::permissions(program, fs::perms::owner_all);
    setenv("PATH", (folder_.path().string() + ":" + old_path_).c_str(), 1);
  }
  ~StandIn() { setenv("PATH", old_path_.c_str(), 1); }
  StandIn(const StandIn&) = delete;
  StandIn& operator=(const StandIn&) = delete;

 private:
  TemporaryFolder folder_;
  std::string old_path_;
};

const VideoShape kShape{4, 2, 29.97};
const std::vector<std::uint8_t> kFrame(4 * 2 * 3, 'x');

TEST(FfmpegVideo, HandsOnEveryFrameAndNamesTheFileAtTheEnd) {
  const StandIn program("echo \"$@\" > \"$out\"; cat >> \"$out\"");
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "below" / "v.mp4";
  FfmpegVideo video(file, kShape);
  video.write(kFrame);
  video.write(kFrame);
  EXPECT_FALSE(fs::exists(file));
  video.commit();
  const std::string written = readTextFile(file);
  EXPECT_NE(written.find("-f rawvideo -pix_fmt rgb24 -s 4x2 -framerate 29.97"), std::string::npos) << written;
  EXPECT_EQ(written.substr(written.find('\n') + 1), std::string(48, 'x'));
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator()), 1);
}

TEST(FfmpegVideo, ItsOwnWordsTellWhyItFailed) {
  const StandIn program("cat > \"$out\"; echo first >&2; echo 'unknown codec' >&2; exit 9");
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "v.mp4";
  const std::string message = thrownMessage<CannotWrite>([&] {
    FfmpegVideo video(file, kShape);
    video.write(kFrame);
    video.commit();
  });
  EXPECT_EQ(message, "cannot write " + file.string() + ": ffmpeg ended with code 9: unknown codec");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// As it ends when it cannot write what closes the file.
TEST(FfmpegVideo, AComplaintIsAFailureEvenWithCode0) {
  const StandIn program("cat > \"$out\"; echo 'Error writing trailer: No space left on device' >&2");
  const TemporaryFolder folder;
  const fs::path file = folder.file("v.mp4", "an older one");
  const std::string message = thrownMessage<CannotWrite>([&] {
    FfmpegVideo video(file, kShape);
    video.write(kFrame);
    video.commit();
  });
  EXPECT_NE(message.find("Error writing trailer: No space left on device"), std::string::npos) << message;
  EXPECT_EQ(readTextFile(file), "an older one");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(FfmpegVideo, EndingBeforeTheLastFrameIsAFailureEvenWithCode0) {
  const StandIn program("echo half > \"$out\"; exec 0<&-; exit 0");
  const TemporaryFolder folder;
  EXPECT_THROW(
      {
        FfmpegVideo video(folder.path() / "v.mp4", kShape);
        for (int k = 0; k < 100000; ++k) video.write(kFrame);
        video.commit();
      },
      CannotWrite);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FfmpegVideo, OneThatIsGivenUpLeavesNothing) {
  const StandIn program("echo half > \"$out\"; exec cat");
  const TemporaryFolder folder;
  {
    FfmpegVideo video(folder.path() / "v.mp4", kShape);
    video.write(kFrame);
    for (int i = 0; i < 1000 && fs::is_empty(folder.path()); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(fs::is_empty(folder.path()));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace carom::demos
