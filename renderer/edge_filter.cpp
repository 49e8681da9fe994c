#include "renderer/edge_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <thread>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr std::uint8_t kThreshold =
    13;  // Of 255, in the channel that differs most: smaller steps are not seen as stairs.
constexpr std::uint8_t kBelow = 1, kRight = 2;

// sRGB bytes to linear light in 15 bits, so that products with 12-bit weights fit an int, and back from 12
// bits.
struct Tables {
  std::array<std::uint16_t, 256> linear{};
  std::array<std::uint8_t, 4096> encoded{};
  Tables() {
    for (std::size_t i = 0; i < linear.size(); ++i) {
      const double s = static_cast<double>(i) / 255.0;
      const double l = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
      linear[i] = static_cast<std::uint16_t>(std::lround(32767.0 * l));
    }
    for (std::size_t i = 0; i < encoded.size(); ++i) {
      const double l = (static_cast<double>(i) + 0.5) / static_cast<double>(encoded.size());
      const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1.0 / 2.4) - 0.055;
      encoded[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(s, 0.0, 1.0)));
    }
  }
};

const Tables& tables() {
  static const Tables instance;
  return instance;
}

// Moves `pixel` towards `neighbour` by `share`, in linear light.
inline void mix(const Tables& t, std::uint8_t* pixel, const std::uint8_t* neighbour, float share) {
  const int weight = static_cast<int>(share * 4096.0f);
  for (int c = 0; c < 3; ++c) {
    const int own = t.linear[pixel[c]], other = t.linear[neighbour[c]];
    const int mixed = own + (((other - own) * weight) >> 12);
    pixel[c] = t.encoded[static_cast<std::size_t>(mixed >> 3)];
  }
}

// A straight run of edge pixels [begin, end) and the height at which the true edge enters and leaves it: +1/2
// on the first side (above, or left), -1/2 on the second, 0 where nothing tells. In between it falls to 0 at
// the middle.
struct Run {
  int begin = 0;
  int end = 0;
  float enters = 0.0f;
  float leaves = 0.0f;
};

float endHeight(bool first_side, bool second_side) {
  if (first_side == second_side) return 0.0f;
  return first_side ? 0.5f : -0.5f;
}

// The area below one half of the line, within pixel i; `t0`, `t1` measure from the run's middle, 1 at its
// end.
float halfArea(float height, float t0, float t1, float half_length) {
  t0 = std::max(t0, 0.0f), t1 = std::min(t1, 1.0f);
  return t1 <= t0 ? 0.0f : 0.5f * height * (t0 + t1) * (t1 - t0) * half_length;
}

// Signed areas that the line cuts off pixel i: of the first side where positive, of the second where
// negative.
struct Cut {
  float first = 0.0f;
  float second = 0.0f;
};
Cut cutOff(const Run& run, int i) {
  const float half = 0.5f * static_cast<float>(run.end - run.begin);
  const float from_begin = static_cast<float>(i - run.begin);
  const float before =
      halfArea(run.enters, (half - from_begin - 1.0f) / half, (half - from_begin) / half, half);
  const float after =
      halfArea(run.leaves, (from_begin - half) / half, (from_begin + 1.0f - half) / half, half);
  return {std::max(before, 0.0f) + std::max(after, 0.0f), std::max(-before, 0.0f) + std::max(-after, 0.0f)};
}

// The first x in [begin, end) whose edge byte has `bit`, or `end`; eight pixels at a time where there are
// none.
int firstMarked(const std::uint8_t* edges, int begin, int end, std::uint8_t bit) {
  const std::uint64_t everywhere = 0x0101010101010101u * bit;
  for (int x = begin; x < end;) {
    std::uint64_t eight = 0;
    if (x + 8 <= end) std::memcpy(&eight, edges + x, sizeof(eight));
    if (x + 8 <= end && (eight & everywhere) == 0) {
      x += 8;
      continue;
    }
    if ((edges[x] & bit) != 0) return x;
    ++x;
  }
  return end;
}

template <typename First, typename Second>
void inParallel(const First& first, const Second& second) {
  std::thread other(first);
  second();
  other.join();
}

}  // namespace

EdgeFilter::EdgeFilter(int width, int height) : width_(width), height_(height) {
  const auto cells = static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2);
  edges_.assign(cells, 0);
  for (std::vector<std::uint8_t>& rows : differs_) rows.assign(2 * 4 * static_cast<std::size_t>(width), 0);
}

void EdgeFilter::apply(const std::vector<std::uint8_t>& rgba, Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  REQUIRE(rgba.size() == 4 * pixels, rgba.size(), width_, height_);
  image.width = width_;
  image.height = height_;
  image.rgb.resize(3 * pixels);
  // What lies between the halves is mixed after both are done: it writes into either.
  const std::uint8_t* source = rgba.data();
  const int row = height_ / 2, column = width_ / 2;
  inParallel(
      [&] {
        takeRows(source, image, {0, row}, differs_[0]);
      },
      [&] {
        takeRows(source, image, {row, height_}, differs_[1]);
      });
  inParallel(
      [&] {
        mixRowPairs(source, image, {0, row - 1});
      },
      [&] {
        mixRowPairs(source, image, {row, height_ - 1});
      });
  mixRowPairs(source, image, {std::max(row - 1, 0), row});
  inParallel(
      [&] {
        mixColumnPairs(source, image, {0, column - 1});
      },
      [&] {
        mixColumnPairs(source, image, {column, width_ - 1});
      });
  mixColumnPairs(source, image, {std::max(column - 1, 0), column});
}

void EdgeFilter::takeRows(const std::uint8_t* rgba, Image& image, Band rows,
                          std::vector<std::uint8_t>& differs) {
  for (int y = rows.begin; y < rows.end; ++y) {
    const std::uint8_t* from = rgba + 4 * static_cast<std::ptrdiff_t>(width_) * (height_ - 1 - y);
    std::uint8_t* to = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(width_) * y;
    // Four bytes at once; the fourth is overwritten by the next pixel, which the last one of a row has not.
    for (std::ptrdiff_t x = 0; x + 1 < width_; ++x) std::memcpy(to + 3 * x, from + 4 * x, 4);
    std::memcpy(to + 3 * (width_ - 1), from + 4 * (width_ - 1), 3);
    markRow(rgba, y, differs);
  }
}

void EdgeFilter::markRow(const std::uint8_t* rgba, int y, std::vector<std::uint8_t>& differs) {
  const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(width_);
  const std::uint8_t* row = rgba + stride * (height_ - 1 - y);
  const std::uint8_t* below = y + 1 < height_ ? row - stride : row;
  std::uint8_t* below_flags = differs.data();
  std::uint8_t* right_flags = differs.data() + stride;
  // Byte by byte and without branches, so that the compiler makes vectors of it.
  const auto flag = [](std::uint8_t a, std::uint8_t b, std::uint8_t bit) {
    const auto difference = static_cast<std::uint8_t>(std::max(a, b) - std::min(a, b));
    return difference > kThreshold ? bit : std::uint8_t{0};
  };
  for (std::ptrdiff_t i = 0; i < stride; ++i) below_flags[i] = flag(row[i], below[i], kBelow);
  for (std::ptrdiff_t i = 0; i + 4 < stride; ++i) right_flags[i] = flag(row[i], row[i + 4], kRight);
  for (std::ptrdiff_t i = 0; i < stride; ++i) below_flags[i] = below_flags[i] | right_flags[i];
  // Fold the four channels of a pixel into one byte; alpha is the same everywhere and adds nothing.
  std::uint8_t* edges = edges_.data() + static_cast<std::ptrdiff_t>(width_ + 2) * (y + 1) + 1;
  for (std::ptrdiff_t x = 0; x < width_; ++x) {
    std::uint32_t flags = 0;
    std::memcpy(&flags, below_flags + 4 * x, sizeof(flags));
    flags |= flags >> 16;
    edges[x] = static_cast<std::uint8_t>(flags | flags >> 8);
  }
}

// Runs along a row, between it (first side) and the row below.
void EdgeFilter::mixRowPairs(const std::uint8_t* rgba, Image& image, Band first_rows) const {
  const Tables& t = tables();
  const std::ptrdiff_t pitch = width_ + 2;
  for (int y = first_rows.begin; y < first_rows.end; ++y) {
    const std::uint8_t* edges = edges_.data() + pitch * (y + 1) + 1;
    const std::uint8_t* source = rgba + 4 * static_cast<std::ptrdiff_t>(width_) * (height_ - 1 - y);
    const std::uint8_t* source_below = source - 4 * static_cast<std::ptrdiff_t>(width_);
    std::uint8_t* out = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(width_) * y;
    std::uint8_t* out_below = out + 3 * static_cast<std::ptrdiff_t>(width_);
    for (int x = firstMarked(edges, 0, width_, kBelow); x < width_;
         x = firstMarked(edges, x + 1, width_, kBelow)) {
      Run run{x, x, 0.0f, 0.0f};
      while (run.end < width_ && (edges[run.end] & kBelow) != 0) ++run.end;
      x = run.end;
      run.enters =
          endHeight((edges[run.begin - 1] & kRight) != 0, (edges[run.begin - 1 + pitch] & kRight) != 0);
      run.leaves = endHeight((edges[run.end - 1] & kRight) != 0, (edges[run.end - 1 + pitch] & kRight) != 0);
      if (run.enters == 0.0f && run.leaves == 0.0f) continue;
      for (std::ptrdiff_t i = run.begin; i < run.end; ++i) {
        const Cut cut = cutOff(run, static_cast<int>(i));
        if (cut.first > 0.0f) mix(t, out + 3 * i, source_below + 4 * i, cut.first);
        if (cut.second > 0.0f) mix(t, out_below + 3 * i, source + 4 * i, cut.second);
      }
    }
  }
}

// Runs along a column, between it (first side) and the column to its right. All columns are walked together,
// row by row, to stay within the cache.
void EdgeFilter::mixColumnPairs(const std::uint8_t* rgba, Image& image, Band first_columns) const {
  const Tables& t = tables();
  const std::ptrdiff_t pitch = width_ + 2;
  const auto finish = [&](std::ptrdiff_t x, Run run) {
    const std::uint8_t* top = edges_.data() + pitch * run.begin + x + 1;   // The row above the run.
    const std::uint8_t* bottom = edges_.data() + pitch * run.end + x + 1;  // The run's last row.
    run.enters = endHeight((top[0] & kBelow) != 0, (top[1] & kBelow) != 0);
    run.leaves = endHeight((bottom[0] & kBelow) != 0, (bottom[1] & kBelow) != 0);
    if (run.enters == 0.0f && run.leaves == 0.0f) return;
    for (int y = run.begin; y < run.end; ++y) {
      const Cut cut = cutOff(run, y);
      const std::uint8_t* source = rgba + 4 * (static_cast<std::ptrdiff_t>(width_) * (height_ - 1 - y) + x);
      std::uint8_t* out = image.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(width_) * y + x);
      if (cut.first > 0.0f) mix(t, out, source + 4, cut.first);
      if (cut.second > 0.0f) mix(t, out + 3, source, cut.second);
    }
  };
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* edges = edges_.data() + pitch * (y + 1) + 1;
    for (int x = firstMarked(edges, first_columns.begin, first_columns.end, kRight); x < first_columns.end;
         x = firstMarked(edges, x + 1, first_columns.end, kRight)) {
      if ((edges[x + pitch] & kRight) != 0) continue;  // A run is handled where it ends.
      Run run{y, y + 1, 0.0f, 0.0f};
      while ((edges_[static_cast<std::size_t>(pitch * run.begin + x + 1)] & kRight) != 0) --run.begin;
      finish(x, run);
    }
  }
}

}  // namespace carom::renderer
