#include "renderer/mesh/picture_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "renderer/image/color.h"

namespace carom::renderer {
namespace {

const std::array<float, 256>& lightOfByte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (int i = 0; i < 256; ++i)
      made[static_cast<std::size_t>(i)] = linearLight(static_cast<float>(i) / 255.0f);
    return made;
  }();
  return table;
}

std::uint8_t byteOfLight(float light) {
  const float c = light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(c, 0.0f, 1.0f)));
}

// A side's pixels of a picture that become one of another: from `first`, with the weights of those covered.
struct Cover {
  int first = 0;
  std::vector<float> weights;
};

// Smaller: the mean of what is covered; larger: between the two nearest, around the picture.
std::vector<Cover> covers(int from, int to) {
  std::vector<Cover> made;
  const double ratio = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    Cover cover;
    if (ratio > 1.0) {
      const double low = i * ratio, high = (i + 1) * ratio;
      cover.first = static_cast<int>(low);
      for (int k = cover.first; k < from && k < high; ++k)
        cover.weights.push_back(
            static_cast<float>((std::min(high, k + 1.0) - std::max(low, static_cast<double>(k))) / ratio));
    } else {
      const double at = (i + 0.5) * ratio - 0.5;
      cover.first = static_cast<int>(std::floor(at));
      const float share = static_cast<float>(at - cover.first);
      cover.weights = {1.0f - share, share};
    }
    made.push_back(std::move(cover));
  }
  return made;
}

}  // namespace

SurfacePicture resizedPicture(const SurfacePicture& picture, int width, int height) {
  if (picture.width == width && picture.height == height) return picture;
  const std::vector<Cover> across = covers(picture.width, width), down = covers(picture.height, height);
  const std::array<float, 256>& light = lightOfByte();
  const auto wrapped = [](int i, int side) { return (i % side + side) % side; };
  SurfacePicture made{width, height, {}};
  made.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const Cover& y : down)
    for (const Cover& x : across) {
      std::array<float, 3> sum{};
      for (std::size_t j = 0; j < y.weights.size(); ++j)
        for (std::size_t i = 0; i < x.weights.size(); ++i) {
          const int row = wrapped(y.first + static_cast<int>(j), picture.height);
          const int column = wrapped(x.first + static_cast<int>(i), picture.width);
          const std::uint8_t* pixel =
              &picture.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                                static_cast<std::size_t>(column))];
          for (std::size_t c = 0; c < 3; ++c) sum[c] += y.weights[j] * x.weights[i] * light[pixel[c]];
        }
      for (const float s : sum) made.rgb.push_back(byteOfLight(s));
    }
  return made;
}

PictureLevels pictureLevels(const SurfacePicture& picture, int width, int height) {
  PictureLevels made{{resizedPicture(picture, width, height)}};
  while (width > 1 || height > 1) {
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
    made.levels.push_back(resizedPicture(made.levels.back(), width, height));
  }
  return made;
}

PictureSize layerSize(std::span<const SurfacePicture> pictures, const PictureBounds& bounds) {
  PictureSize size;
  const auto side = [&bounds](int pixels) {
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::min(pixels, bounds.side))));
  };
  for (const SurfacePicture& picture : pictures) {
    size.width = std::max(size.width, side(picture.width));
    size.height = std::max(size.height, side(picture.height));
  }
  const auto bytes = [&] {
    return 4 * pictures.size() * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  };
  while (bytes() > bounds.bytes && std::max(size.width, size.height) > 1)
    (size.width >= size.height ? size.width : size.height) /= 2;
  return size;
}

}  // namespace carom::renderer
