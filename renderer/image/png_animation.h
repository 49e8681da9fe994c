#pragma once
// Animated PNG (APNG 1.0): one file that viewers and browsers play in a loop, every pixel of every frame
// exact; what knows no animations shows the first frame. A frame holds the smallest rectangle in which it
// differs from the one before. Packed by the PNG encoder of png.h. Tested in
// tests/renderer/image/png_animation_test.cpp.

#include <cstdint>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/image/png.h"

namespace carom::renderer {

/// How long a frame is shown: numerator / denominator seconds.
struct FrameDelay {
  std::uint16_t numerator = 1;
  std::uint16_t denominator = 1;
};
/// The fraction that is nearest to 1 / fps, of those the one with the smallest denominator.
FrameDelay frameDelay(double fps);

class PngAnimation {
 public:
  PngAnimation(int frames, const FrameDelay& delay, PngText text);

  /// The file's next bytes: the first frame brings its head and the last one its end. All frames have one
  /// size.
  std::vector<std::uint8_t> add(const Image& image);

 private:
  int frames_ = 0;
  FrameDelay delay_;
  PngText text_;
  int added_ = 0;
  std::uint32_t sequence_ = 0;
  Image last_;
};

}  // namespace carom::renderer
