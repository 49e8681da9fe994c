#pragma once
// A video file through the ffmpeg program of the user, if there is one; it is run, not linked. The file
// appears whole or not at all. Tested in tests/demos/video/ffmpeg_video_test.cpp with a stand-in, and through
// the program in tests/demos/render/long_jobs_test.cpp.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include <sys/types.h>

#include "demos/system/atomic_file.h"
#include "demos/system/pipe_writer.h"

namespace carom::demos {

struct VideoShape {
  int width = 0;
  int height = 0;
  double fps = 0.0;
};

class FfmpegVideo {
 public:
  /// Starts ffmpeg. Throws CannotWrite when there is none on the PATH, or no such folder to write to.
  FfmpegVideo(const std::filesystem::path& path, const VideoShape& shape);
  /// A video that was not committed is given up: ffmpeg ends and its file goes.
  ~FfmpegVideo();
  FfmpegVideo(const FfmpegVideo&) = delete;
  FfmpegVideo& operator=(const FfmpegVideo&) = delete;

  /// Width x height x 3 bytes of one frame. Throws CannotWrite with ffmpeg's last line when it has given up.
  void write(std::span<const std::uint8_t> rgb);
  /// Waits for ffmpeg and gives the file its name. Throws CannotWrite.
  void commit();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void runFfmpeg(const VideoShape& shape, int input) const;
  int endInput();
  [[noreturn]] void failAfter(int code) const;
  [[noreturn]] void fail(const std::string& reason) const;
  std::string lastComplaint() const;

  std::filesystem::path path_;
  std::optional<TemporaryFile> temporary_;            // ffmpeg writes it; it is held here
  std::unique_ptr<std::FILE, CloseFile> complaints_;  // what ffmpeg says on stderr
  pid_t child_ = -1;
  int input_ = -1;
  std::optional<PipeWriter> pipe_;
};

}  // namespace carom::demos
