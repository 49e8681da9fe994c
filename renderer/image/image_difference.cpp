#include "renderer/image/image_difference.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>
#include <vector>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

// Of 255: what a pixel beyond the tolerance shows at the least.
constexpr int kLeastBright = 85;

bool hasColor(int channels) {
  return channels >= 3;
}
bool hasAlpha(int channels) {
  return channels == 2 || channels == 4;
}

int commonChannels(int a, int b) {
  const bool color = hasColor(a) || hasColor(b);
  const bool alpha = hasAlpha(a) || hasAlpha(b);
  return (color ? 3 : 1) + (alpha ? 1 : 0);
}

const char* channelName(int channel, int channels) {
  if (hasAlpha(channels) && channel == channels - 1) return "alpha";
  if (!hasColor(channels)) return "grey";
  constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
  return kNames[static_cast<std::size_t>(channel)];
}

/// Grey becomes three equal channels, no alpha becomes opaque.
Raster widened(const Raster& from, int channels) {
  Raster to{from.width, from.height, channels, from.bits, {}};
  const std::size_t pixels = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height);
  to.samples.reserve(pixels * static_cast<std::size_t>(channels));
  const int colors = hasColor(channels) ? 3 : 1;
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x) {
      const std::uint16_t* p = from.pixel(x, y);
      for (int c = 0; c < colors; ++c) to.samples.push_back(p[hasColor(from.channels) ? c : 0]);
      if (!hasAlpha(channels)) continue;
      const std::uint16_t opaque = static_cast<std::uint16_t>(from.fullScale());
      to.samples.push_back(hasAlpha(from.channels) ? p[from.channels - 1] : opaque);
    }
  return to;
}

/// Calls `use(a, b)` with both rasters in the same channels.
template <typename Use>
auto withCommonChannels(const Raster& a, const Raster& b, Use&& use) {
  REQUIRE(comparable(a, b), a.width, a.height, a.bits, b.width, b.height, b.bits);
  if (a.channels == b.channels) return use(a, b);
  return use(inCommonChannels(a, b), inCommonChannels(b, a));
}

struct TileSum {
  std::int64_t pixels_beyond = 0;
  std::int64_t sum = 0;
  bool operator<(const TileSum& other) const {
    return std::pair(pixels_beyond, sum) < std::pair(other.pixels_beyond, other.sum);
  }
};

/// The sums of a grid of tiles, row by row.
class Tiles {
 public:
  explicit Tiles(const Raster& raster)
      : width_(raster.width), height_(raster.height), columns_((raster.width + kTileSide - 1) / kTileSide) {
    const int rows = (raster.height + kTileSide - 1) / kTileSide;
    sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
  }
  TileSum& at(int x, int y) {
    return sums_[static_cast<std::size_t>(y / kTileSide * columns_ + x / kTileSide)];
  }

  Tile worst() const {
    const int index = static_cast<int>(std::max_element(sums_.begin(), sums_.end()) - sums_.begin());
    const int x = index % columns_ * kTileSide;
    const int y = index / columns_ * kTileSide;
    return {x, y, std::min(kTileSide, width_ - x), std::min(kTileSide, height_ - y),
            sums_[static_cast<std::size_t>(index)].pixels_beyond};
  }

 private:
  int width_, height_, columns_;
  std::vector<TileSum> sums_;
};

ImageDifference measured(const Raster& a, const Raster& b, int tolerance) {
  ImageDifference difference;
  difference.full_scale = a.fullScale();
  Tiles tiles(a);
  std::int64_t total = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::uint16_t* p = a.pixel(x, y);
      const std::uint16_t* q = b.pixel(x, y);
      int largest = 0, sum = 0, channel = 0;
      for (int c = 0; c < a.channels; ++c) {
        const int step = std::abs(p[c] - q[c]);
        sum += step;
        if (step <= largest) continue;
        largest = step;
        channel = c;
      }
      if (largest == 0) continue;
      ++difference.pixels_different;
      total += sum;
      TileSum& tile = tiles.at(x, y);
      tile.sum += sum;
      if (largest > tolerance) {
        ++difference.pixels_beyond;
        ++tile.pixels_beyond;
      }
      if (largest <= difference.largest) continue;
      difference.largest = largest;
      difference.largest_x = x;
      difference.largest_y = y;
      difference.largest_channel = channelName(channel, a.channels);
    }
  difference.mean = static_cast<double>(total) / static_cast<double>(a.samples.size());
  difference.worst_tile = tiles.worst();
  return difference;
}

/// One pixel of the picture from the pixel's steps in each channel.
std::array<std::uint8_t, 3> pictured(const std::uint16_t* p, const std::uint16_t* q, const Raster& raster,
                                     const DifferencePicture& how) {
  std::array<int, 3> shown{};
  int largest = 0, brightest = 0;
  for (int c = 0; c < raster.channels; ++c) {
    const int step = std::abs(p[c] - q[c]);
    const std::int64_t bright = static_cast<std::int64_t>(step) * how.amplify * 255 / raster.fullScale();
    const int level = static_cast<int>(std::min<std::int64_t>(bright, 255));
    largest = std::max(largest, step);
    brightest = std::max(brightest, level);
    const bool own = hasColor(raster.channels) && c < 3;  // grey and alpha go to all three
    for (int k = own ? c : 0; k < (own ? c + 1 : 3); ++k) {
      int& target = shown[static_cast<std::size_t>(k)];
      target = std::max(target, level);
    }
  }
  if (largest > how.tolerance && brightest < kLeastBright)
    for (int& level : shown) level += kLeastBright - brightest;
  return {static_cast<std::uint8_t>(shown[0]), static_cast<std::uint8_t>(shown[1]),
          static_cast<std::uint8_t>(shown[2])};
}

}  // namespace

bool comparable(const Raster& a, const Raster& b) {
  return a.width == b.width && a.height == b.height && a.bits == b.bits;
}

Raster inCommonChannels(const Raster& a, const Raster& b) {
  const int channels = commonChannels(a.channels, b.channels);
  return a.channels == channels ? a : widened(a, channels);
}

std::string shapeText(const RasterShape& shape) {
  constexpr std::array<const char*, 4> kKinds = {"grey", "grey with alpha", "RGB", "RGBA"};
  return std::to_string(shape.width) + "x" + std::to_string(shape.height) + " " + std::to_string(shape.bits) +
         "-bit " + kKinds[static_cast<std::size_t>(shape.channels - 1)];
}

ImageDifference differenceOf(const Raster& a, const Raster& b, int tolerance) {
  return withCommonChannels(a, b,
                            [&](const Raster& p, const Raster& q) { return measured(p, q, tolerance); });
}

Image differenceImage(const Raster& a, const Raster& b, const DifferencePicture& how) {
  return withCommonChannels(a, b, [&](const Raster& p, const Raster& q) {
    Image image{p.width, p.height, {}};
    image.rgb.reserve(3 * static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height));
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        for (const std::uint8_t level : pictured(p.pixel(x, y), q.pixel(x, y), p, how))
          image.rgb.push_back(level);
    return image;
  });
}

}  // namespace carom::renderer
