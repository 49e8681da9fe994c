#pragma once
// Images in memory, top row first: 8-bit sRGB, and what lies behind each pixel.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::renderer {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;         ///< width * height * 3, rows from top to bottom.
  std::vector<std::uint8_t> alpha = {};  ///< width * height, or empty: the image is opaque.

  const std::uint8_t* pixel(int x, int y) const {
    return rgb.data() +
           3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// How far away what each pixel shows is, along the view axis.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> depth_m;  ///< width * height, rows from top to bottom; +infinity for the sky.
};

}  // namespace carom::renderer
