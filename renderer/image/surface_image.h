#pragma once
// What lies behind each pixel: depth, world normal and instance of the surface that the ray through the
// pixel's middle meets first. The rule is the pixel's middle alone: no smoothing of edges, no bevels and no
// facets of round bodies move these images, while they lie pixel on pixel with the colour frame.

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/image/image.h"

namespace carom::renderer {

inline constexpr std::int32_t kSky = -1;

struct SurfaceImage {
  DepthImage depth;
  std::vector<std::array<float, 3>> normal_W;  ///< Unit, outwards; zero for the sky.
  std::vector<std::int32_t> instance;          ///< Index into the instances drawn, or kSky.
};

}  // namespace carom::renderer
