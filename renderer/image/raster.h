#pragma once
// Pixels as a file holds them, for comparing: 8 or 16 bits a sample, 1 to 4 channels, top row first. Depth
// and id images keep all their bits here; pictures to be drawn or shown are Images.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::renderer {

/// What a raster is without its pixels.
struct RasterShape {
  int width = 0;
  int height = 0;
  int channels = 3;
  int bits = 8;
};

struct Raster {
  int width = 0;
  int height = 0;
  int channels = 3;                    ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha.
  int bits = 8;                        ///< A sample's: 8 or 16.
  std::vector<std::uint16_t> samples;  ///< width * height * channels, rows from top to bottom.

  /// A sample's largest value: 255 or 65535.
  int fullScale() const { return bits == 16 ? 65535 : 255; }
  RasterShape shape() const { return {width, height, channels, bits}; }
  const std::uint16_t* pixel(int x, int y) const {
    const std::size_t index =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    return samples.data() + index * static_cast<std::size_t>(channels);
  }
};

}  // namespace carom::renderer
