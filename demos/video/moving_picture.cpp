#include "demos/video/moving_picture.h"

#include <algorithm>
#include <array>

#include "demos/system/atomic_file.h"
#include "renderer/image/png_animation.h"

namespace carom::demos {
namespace {

constexpr const char* kAnimatedPng = ".apng";

class AnimatedPng : public MovingPicture {
 public:
  AnimatedPng(const std::filesystem::path& path, const VideoShape& shape, int frames,
              const renderer::PngText& text)
      : file_(path), shape_(shape), animation_(frames, renderer::frameDelay(shape.fps), text) {}
  void write(std::span<const std::uint8_t> rgb) override {
    file_.write(animation_.add({shape_.width, shape_.height, {rgb.begin(), rgb.end()}}));
  }
  void commit() override { file_.commit(); }

 private:
  AtomicFile file_;
  VideoShape shape_;
  renderer::PngAnimation animation_;
};

class Video : public MovingPicture {
 public:
  Video(const std::filesystem::path& path, const VideoShape& shape) : video_(path, shape) {}
  void write(std::span<const std::uint8_t> rgb) override { video_.write(rgb); }
  void commit() override { video_.commit(); }

 private:
  FfmpegVideo video_;
};

}  // namespace

bool isMovingPicture(const std::filesystem::path& path) {
  constexpr std::array<const char*, 8> kEndings{kAnimatedPng, ".gif", ".webp", ".mp4",
                                                ".mov",       ".mkv", ".webm", ".avi"};
  return std::find(kEndings.begin(), kEndings.end(), path.extension()) != kEndings.end();
}

std::unique_ptr<MovingPicture> makeMovingPicture(const std::filesystem::path& path, const VideoShape& shape,
                                                 int frames, const renderer::PngText& text) {
  removeAbandoned(path.parent_path(), {path.filename().string()});
  if (path.extension() == kAnimatedPng) return std::make_unique<AnimatedPng>(path, shape, frames, text);
  return std::make_unique<Video>(path, shape);
}

}  // namespace carom::demos
