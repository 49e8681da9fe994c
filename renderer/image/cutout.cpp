#include "renderer/image/cutout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/foundation/contract.h"
#include "renderer/image/color.h"

namespace carom::renderer {
namespace {

std::uint8_t encoded(float light) {
  const float s = light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(s, 0.0f, 1.0f)));
}

}  // namespace

void unmultiply(Image& image) {
  REQUIRE(image.rgb.size() == 3 * image.alpha.size(), image.rgb.size(), image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const std::uint8_t alpha = image.alpha[i];
    if (alpha == 255) continue;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const float light = linearLight(static_cast<float>(image.rgb[k]) / 255.0f);
      image.rgb[k] = alpha == 0 ? std::uint8_t{0} : encoded(255.0f * light / static_cast<float>(alpha));
    }
  }
}

Raster rasterOf(const Image& image) {
  REQUIRE(image.rgb.size() == 3 * image.alpha.size(), image.rgb.size(), image.alpha.size());
  Raster raster{image.width, image.height, 4, 8, {}};
  raster.samples.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    raster.samples.insert(raster.samples.end(),
                          {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2], image.alpha[i]});
  return raster;
}

Image imageOf(const Raster& raster) {
  REQUIRE(raster.channels == 4 && raster.bits == 8, raster.channels, raster.bits);
  Image image{raster.width, raster.height, {}, {}};
  for (std::size_t i = 0; i < raster.samples.size(); i += 4) {
    for (std::size_t k = i; k < i + 3; ++k) image.rgb.push_back(static_cast<std::uint8_t>(raster.samples[k]));
    image.alpha.push_back(static_cast<std::uint8_t>(raster.samples[i + 3]));
  }
  return image;
}

}  // namespace carom::renderer
