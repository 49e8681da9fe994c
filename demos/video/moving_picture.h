#pragma once
// A moving picture: one file that takes frame after frame and appears whole or not at all. What it is follows
// from its name's ending: an animated PNG is written here, all others by the user's ffmpeg. Tested in
// tests/demos/video/moving_picture_test.cpp.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "demos/video/ffmpeg_video.h"
#include "renderer/image/png.h"

namespace carom::demos {

/// Whether the name ends as a moving picture does: .apng, .gif, .webp, .mp4, .mov, .mkv, .webm or .avi.
bool isMovingPicture(const std::filesystem::path& path);
/// Those endings, for messages.
inline constexpr const char* kMovingPictures = ".apng, .gif, .webp, .mp4, .mov, .mkv, .webm or .avi";

class MovingPicture {
 public:
  virtual ~MovingPicture() = default;
  /// Width x height x 3 bytes of the next frame. Throws CannotWrite.
  virtual void write(std::span<const std::uint8_t> rgb) = 0;
  /// After the last frame: gives the file its name. Throws CannotWrite.
  virtual void commit() = 0;
};

/// Of so many frames; `text` is what the file says of itself, where it can. Throws CannotWrite, where there
/// is no ffmpeg, too.
std::unique_ptr<MovingPicture> makeMovingPicture(const std::filesystem::path& path, const VideoShape& shape,
                                                 int frames, const renderer::PngText& text);

}  // namespace carom::demos
