#pragma once
// An animated PNG that keeps to a size: for pages that show many at once. Colours come from one palette, a
// frame holds the smallest rectangle that differs from the one before with what did not change left out, and
// where that is still too much, colours, frames a second and size give way in turn. Tested in
// tests/demos/video/small_animation_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "demos/video/palette.h"
#include "renderer/image/png_animation.h"

namespace carom::demos {

struct Fidelity {
  int colors = 255;   ///< At most 255.
  int tolerance = 0;  ///< A pixel keeps the colour that it shows while each channel is so near to its own.
};

/// The pictures, of one size, each shown for `delay`, the last one for longer, for ever.
std::vector<std::uint8_t> indexedAnimation(std::span<const renderer::Image> pictures,
                                           const renderer::FrameDelay& delay, const Fidelity& fidelity);

/// The picture at `width` columns, each pixel the mean of what it covers.
renderer::Image smaller(const renderer::Image& picture, int width);

struct SmallAnimation {
  std::vector<std::uint8_t> moving;
  std::vector<std::uint8_t> still;  ///< Its first frame, whose size is as small.
  int width = 0;
  int height = 0;
  double fps = 0.0;
};
/// Of pictures at twice the frames a second that are wanted: `fps` is the wanted rate. The first in the order
/// of quality that has at most `most_bytes`, or the last.
SmallAnimation smallAnimation(const std::vector<renderer::Image>& pictures, double fps,
                              std::size_t most_bytes);

}  // namespace carom::demos
