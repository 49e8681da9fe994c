#include "renderer/image/edge_filter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

constexpr std::uint8_t kThreshold =
    13;  // Of 255, in the channel that differs most: smaller steps are not seen as stairs.
constexpr int kWhole = 4096;  // The weight of a whole pixel.

// Whether two pixels differ visibly.
bool differs(const std::uint8_t* a, const std::uint8_t* b) {
  return std::abs(a[0] - b[0]) > kThreshold || std::abs(a[1] - b[1]) > kThreshold ||
         std::abs(a[2] - b[2]) > kThreshold || std::abs(a[3] - b[3]) > kThreshold;
}

// The same of 32 pixels at once, the first in the lowest bit.
// Hand-laid vectors of four pixels: a pixel differs where its lane is more than the threshold in any byte.
constexpr int kBlock = 32;
typedef std::uint8_t Bytes __attribute__((vector_size(16)));
typedef std::uint32_t Lanes __attribute__((vector_size(16)));
std::uint32_t differing(const std::uint8_t* a, const std::uint8_t* b) {
  const Bytes least = Bytes{} + kThreshold;
  Lanes weight = {1, 2, 4, 8}, sum = {};
  for (int i = 0; i < kBlock / 4; ++i) {
    Bytes p, q;
    std::memcpy(&p, a + 16 * i, sizeof(p));
    std::memcpy(&q, b + 16 * i, sizeof(q));
    const Bytes difference = (p > q ? p : q) - (p > q ? q : p);
    const Bytes raised = difference > least ? difference : least;
    sum |= weight & ((Lanes)raised != (Lanes)least);
    weight <<= 4;
  }
  return sum[0] | sum[1] | sum[2] | sum[3];
}

// sRGB bytes to linear light in 15 bits, so that products with 12-bit weights fit an int, and back from 12
// bits.
struct Tables {
  std::array<std::uint16_t, 256> linear{};
  std::array<std::uint8_t, 4096> encoded{};
  explicit Tables(bool even) {
    for (std::size_t i = 0; even && i < linear.size(); ++i)
      linear[i] = static_cast<std::uint16_t>(std::lround(32767.0 * static_cast<double>(i) / 255.0));
    for (std::size_t i = 0; even && i < encoded.size(); ++i)
      encoded[i] = static_cast<std::uint8_t>((255 * i + encoded.size() / 2) / (encoded.size() - 1));
    if (even) return;
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

const Tables& tables(bool even) {
  static const Tables srgb(false), light(true);
  return even ? light : srgb;
}

// Moves `pixel` towards `neighbour` by `weight`, in linear light.
inline void mix(const Tables& t, std::uint8_t* pixel, const std::uint8_t* neighbour, int weight) {
  const auto mixed = [&](std::uint8_t own_byte, std::uint8_t other_byte) {
    const int own = t.linear[own_byte], other = t.linear[other_byte];
    return t.encoded[static_cast<std::size_t>((own + (((other - own) * weight) >> 12)) >> 3)];
  };
  pixel[0] = mixed(pixel[0], neighbour[0]);
  pixel[1] = mixed(pixel[1], neighbour[1]);
  pixel[2] = mixed(pixel[2], neighbour[2]);
}

// The two pixels of an edge, of its first side (above, or left) and of its second, in the source and in the
// image.
struct Pair {
  const std::uint8_t* source[2];
  std::uint8_t* out[2];
  std::ptrdiff_t source_step;  // To the next pair of the run.
  std::ptrdiff_t out_step;

  void mixOne(const Tables& t, std::ptrdiff_t i, int side, int weight) const {
    mix(t, out[side] + i * out_step, source[1 - side] + i * source_step, weight);
  }
};

// A straight run of edge pixels. The true edge enters and leaves it half a pixel off, on the first side where
// +1, on the second where -1; 0 where nothing tells. In between it falls to the pixels' border at the middle.
struct Run {
  int length = 0;
  int enters = 0;
  int leaves = 0;
};

int endSide(bool first_side, bool second_side) {
  return static_cast<int>(first_side) - static_cast<int>(second_side);
}

// The part of a run that is mixed: pixels [begin, end) of it, on either side or one.
struct Part {
  int begin = 0;
  int end = 0;
  bool side[2] = {true, true};
};

// Mixes what the line cuts off each pixel of the run: under half of it, of length n / 2 and height 1/2, pixel
// k holds (n - 2k - 1) / 2n, and the middle one of an odd number 1 / 8n of either half.
void mixRun(const Tables& t, const Run& run, const Part& part, const Pair& pair) {
  const int n = run.length;
  const float each = 0.5f * static_cast<float>(kWhole) / static_cast<float>(n);
  const auto weight = [&](int k) { return static_cast<int>(each * static_cast<float>(n - 2 * k - 1)); };
  const auto mixHalf = [&](int tells, int begin, int end, const auto& fromEnd) {
    const int side = tells > 0 ? 0 : 1;
    if (tells == 0 || !part.side[side]) return;
    for (int i = std::max(begin, part.begin); i < std::min(end, part.end); ++i)
      pair.mixOne(t, i, side, weight(fromEnd(i)));
  };
  mixHalf(run.enters, 0, n / 2, [](int i) { return i; });
  mixHalf(run.leaves, n - n / 2, n, [n](int i) { return n - 1 - i; });
  if (n % 2 == 0 || n / 2 < part.begin || n / 2 >= part.end) return;
  const int both = run.enters + run.leaves;
  const int middle = static_cast<int>(0.25f * each * static_cast<float>(std::max(std::abs(both), 1)));
  if (both >= 0 && part.side[0]) pair.mixOne(t, n / 2, 0, middle);
  if (both <= 0 && part.side[1]) pair.mixOne(t, n / 2, 1, middle);
}

}  // namespace

EdgeFilter::EdgeFilter(int width, int height)
    : width_(width), height_(height), words_(static_cast<std::size_t>(width) / 64 + 2) {
  below_.assign(words_ * static_cast<std::size_t>(height + 1), 0);
  right_ = below_;
  begins_.assign(static_cast<std::size_t>(width), 0);
}

void EdgeFilter::check(const std::vector<std::uint8_t>& rgba) const {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  REQUIRE(rgba.size() == 4 * pixels, rgba.size(), width_, height_);
}

void EdgeFilter::apply(const std::vector<std::uint8_t>& rgba, Image& image) {
  check(rgba);
  image.width = width_;
  image.height = height_;
  image.rgb.resize(rgba.size() / 4 * 3);
  const Window whole{0, width_, 0, height_};
  for (int y = 0; y < height_; ++y) {
    markRow(rgba.data(), y);
    takeRow(rgba.data(), y, whole, image);
    if (y > 0) mixRowPair(rgba.data(), y - 1, whole, image);
  }
  mixColumnPairs(rgba.data(), whole, image);
}

void EdgeFilter::applyToAlpha(const std::vector<std::uint8_t>& rgba, Image& image) {
  check(rgba);
  std::vector<std::uint8_t> grey(rgba.size());
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    std::fill_n(grey.begin() + static_cast<std::ptrdiff_t>(i), 4, rgba[i + 3]);
  Image behind{width_, height_, std::vector<std::uint8_t>(rgba.size() / 4 * 3), {}};
  even_ = true;
  filter(grey.data(), {0, width_, 0, height_}, behind);
  even_ = false;
  image.alpha.resize(rgba.size() / 4);
  for (std::size_t i = 0; i < image.alpha.size(); ++i)
    image.alpha[i] = static_cast<std::uint8_t>(255 - behind.rgb[3 * i]);
}

void EdgeFilter::applyAgain(const std::vector<std::uint8_t>& rgba, std::span<const GridBlock> blocks,
                            Image& image) {
  check(rgba);
  REQUIRE(image.width == width_ && image.height == height_, image.width, image.height);
  std::vector<Window> changed;
  for (const GridBlock& b : blocks)
    if (!b.isEmpty()) changed.push_back({b.x_begin, b.x_end, height_ - b.y_end, height_ - b.y_begin});
  for (const Window& window : changed)
    for (int y = std::max(window.top - 1, 0); y < window.bottom; ++y) markRow(rgba.data(), y);
  for (const Window& window : changed) filter(rgba.data(), reached(window), image);
}

// The pixels that are mixed on account of those in `changed`: as far as the runs go that pass near them. What
// is marked outside of a change is what was marked there before, so that no run went farther then.
EdgeFilter::Window EdgeFilter::reached(const Window& changed) const {
  constexpr int kBeside = 2;  // A run that ends so near may owe its end to the change.
  const Window near{std::max(changed.left - kBeside, 0), std::min(changed.right + kBeside, width_),
                    std::max(changed.top - kBeside, 0), std::min(changed.bottom + kBeside, height_)};
  Window window = near;
  for (int y = near.top; y < near.bottom; ++y) {
    int left = near.left, right = near.right;
    while (left > 0 && isMarked(below_, left, y)) --left;
    while (right < width_ && isMarked(below_, right - 1, y)) ++right;
    window.left = std::min(window.left, left);
    window.right = std::max(window.right, right);
  }
  for (int x = near.left; x < near.right; ++x) {
    int top = near.top, bottom = near.bottom;
    while (top > 0 && isMarked(right_, x, top)) --top;
    while (bottom < height_ && isMarked(right_, x, bottom - 1)) ++bottom;
    window.top = std::min(window.top, top);
    window.bottom = std::max(window.bottom, bottom);
  }
  return window;
}

// Makes the image's pixels within `window` of `rgba`, whose pixels are all marked.
void EdgeFilter::filter(const std::uint8_t* rgba, const Window& window, Image& image) {
  for (int y = window.top; y < window.bottom; ++y) {
    takeRow(rgba, y, window, image);
    if (y > 0) mixRowPair(rgba, y - 1, window, image);
  }
  if (window.bottom < height_) mixRowPair(rgba, window.bottom - 1, window, image);
  mixColumnPairs(rgba, window, image);
}

void EdgeFilter::takeRow(const std::uint8_t* rgba, int y, const Window& window, Image& image) const {
  const std::uint8_t* from = rgba + 4 * static_cast<std::ptrdiff_t>(width_) * (height_ - 1 - y);
  std::uint8_t* to = image.rgb.data() + 3 * static_cast<std::ptrdiff_t>(width_) * y;
  // Four bytes at once; the fourth is overwritten by the next pixel, which the last one has not.
  const std::ptrdiff_t last = window.right - 1;
  for (std::ptrdiff_t x = window.left; x < last; ++x) std::memcpy(to + 3 * x, from + 4 * x, 4);
  std::memcpy(to + 3 * last, from + 4 * last, 3);
}

void EdgeFilter::markRow(const std::uint8_t* rgba, int y) {
  const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(width_);
  const std::uint8_t* row = rgba + stride * (height_ - 1 - y);
  const std::uint8_t* below = y + 1 < height_ ? row - stride : row;
  for (std::size_t word = 0; word < words_; ++word) {
    const auto half = [&](const std::uint8_t* other, int last, int x) {
      const int left = last - x;
      const std::ptrdiff_t at = 4 * static_cast<std::ptrdiff_t>(x);
      if (left >= kBlock) return Bits{differing(row + at, other + at)};
      Bits bits = 0;
      for (int i = 0; i < left; ++i) bits |= Bits{differs(row + at + 4 * i, other + at + 4 * i)} << i;
      return bits;
    };
    const int x = static_cast<int>(64 * word);
    below_[wordAt(y) + word] = half(below, width_, x) | half(below, width_, x + kBlock) << kBlock;
    right_[wordAt(y) + word] = half(row + 4, width_ - 1, x) | half(row + 4, width_ - 1, x + kBlock) << kBlock;
  }
}

bool EdgeFilter::isMarked(const std::vector<Bits>& bits, int x, int y) const {
  if (x < 0 || y < 0) return false;
  return (bits[wordAt(y) + static_cast<std::size_t>(x) / 64] >> (x % 64) & 1) != 0;
}

// Runs along row y, between it (first side) and the row below.
void EdgeFilter::mixRowPair(const std::uint8_t* rgba, int y, const Window& window, Image& image) const {
  const Tables& t = tables(even_);
  const Bits* bits = below_.data() + wordAt(y);
  const std::ptrdiff_t source_row = 4 * static_cast<std::ptrdiff_t>(width_),
                       out_row = 3 * static_cast<std::ptrdiff_t>(width_);
  const std::uint8_t* source = rgba + source_row * (height_ - 1 - y);
  std::uint8_t* out = image.rgb.data() + out_row * y;
  // The first bit from x on that is not like those of `like`.
  const auto firstFrom = [&](int x, Bits like) {
    std::size_t word = static_cast<std::size_t>(x) / 64;
    Bits found = (bits[word] ^ like) >> (x % 64) << (x % 64);
    while (found == 0 && word + 1 < words_) found = bits[++word] ^ like;
    return found == 0 ? width_ : static_cast<int>(64 * word) + std::countr_zero(found);
  };
  int first = window.left;
  while (first > 0 && isMarked(below_, first, y)) --first;
  for (int begin = firstFrom(first, 0), end = 0; begin < window.right; begin = firstFrom(end, 0)) {
    end = firstFrom(begin, ~Bits{0});
    const Run run{end - begin, endSide(isMarked(right_, begin - 1, y), isMarked(right_, begin - 1, y + 1)),
                  endSide(isMarked(right_, end - 1, y), isMarked(right_, end - 1, y + 1))};
    if (run.enters == 0 && run.leaves == 0) continue;
    const std::ptrdiff_t x = begin;
    mixRun(t, run, {window.left - begin, window.right - begin, {window.hasRow(y), window.hasRow(y + 1)}},
           {{source + 4 * x, source - source_row + 4 * x}, {out + 3 * x, out + out_row + 3 * x}, 4, 3});
  }
}

// Runs along a column, between it (first side) and the column to its right. All columns are walked together,
// row by row, to stay within the cache; a pixel is mixed by the run that ends first, then by the left one.
void EdgeFilter::mixColumnPairs(const std::uint8_t* rgba, const Window& window, Image& image) {
  const Tables& t = tables(even_);
  const std::ptrdiff_t source_row = 4 * static_cast<std::ptrdiff_t>(width_),
                       out_row = 3 * static_cast<std::ptrdiff_t>(width_);
  const auto finish = [&](int x, int begin, int end) {
    const Run run{end - begin, endSide(isMarked(below_, x, begin - 1), isMarked(below_, x + 1, begin - 1)),
                  endSide(isMarked(below_, x, end - 1), isMarked(below_, x + 1, end - 1))};
    if (run.enters == 0 && run.leaves == 0) return;
    const std::uint8_t* source =
        rgba + source_row * (height_ - 1 - begin) + 4 * static_cast<std::ptrdiff_t>(x);
    std::uint8_t* out = image.rgb.data() + out_row * begin + 3 * static_cast<std::ptrdiff_t>(x);
    mixRun(t, run,
           {window.top - begin, window.bottom - begin, {window.hasColumn(x), window.hasColumn(x + 1)}},
           {{source, source + 4}, {out, out + 3}, -source_row, out_row});
  };
  const int left = std::max(window.left - 1, 0), right = window.right;
  const std::size_t first_word = static_cast<std::size_t>(left) / 64,
                    end_word = static_cast<std::size_t>(right - 1) / 64 + 1;
  const auto forEach = [&](std::size_t word, Bits bits, const auto& act) {
    const int at = static_cast<int>(64 * word);
    if (at < left) bits = bits >> (left - at) << (left - at);
    if (right - at < 64) bits &= (Bits{1} << (right - at)) - 1;
    for (; bits != 0; bits &= bits - 1) act(at + std::countr_zero(bits));
  };
  open_.clear();
  for (int y = window.top; y < window.bottom; ++y)
    for (std::size_t word = first_word; word < end_word; ++word) {
      const Bits here = right_[wordAt(y) + word], next = right_[wordAt(y + 1) + word];
      const Bits before = y > window.top ? right_[wordAt(y - 1) + word] : 0;
      forEach(word, here & ~before, [&](int x) {
        int begin = y;
        while (y == window.top && isMarked(right_, x, begin - 1)) --begin;
        begins_[static_cast<std::size_t>(x)] = begin;
      });
      forEach(word, here & ~next, [&](int x) { finish(x, begins_[static_cast<std::size_t>(x)], y + 1); });
      if (y + 1 < window.bottom) continue;
      forEach(word, here & next, [&](int x) {
        int end = y + 1;
        while (isMarked(right_, x, end)) ++end;
        open_.emplace_back(end, x);
      });
    }
  std::sort(open_.begin(), open_.end());
  for (const auto& [end, x] : open_) finish(x, begins_[static_cast<std::size_t>(x)], end);
}

}  // namespace carom::renderer
