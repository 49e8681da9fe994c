#pragma once
// The mean of several exposures of one frame, taken in linear light: whole numbers, so that the result does
// not depend on any rounding. Tested in tests/renderer/view/multiple_exposure_test.cpp.

#include <cstdint>
#include <vector>

#include "renderer/image/image.h"

namespace carom::renderer {

class MultipleExposure {
 public:
  /// At most 2^16 exposures, all of one size.
  void add(const Image& image);
  /// Writes the mean of what was added since the last call over the pixels of `image`.
  void develop(Image& image);

 private:
  std::vector<std::uint32_t> light_;  // Sums of 16-bit linear light, three a pixel.
  std::vector<std::uint32_t> alpha_;  // Sums of alpha, of images that have it.
  std::uint32_t count_ = 0;
};

}  // namespace carom::renderer
