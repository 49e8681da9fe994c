#include "demos/video/small_animation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "engine/foundation/contract.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

constexpr int kLastShown = 12;        // Times as long as the others: a moment to see the end.
constexpr std::uint8_t kIndexed = 3;  // PNG's colour type.

/// How much a picture is reduced: in this order, until it fits.
struct Step {
  Fidelity fidelity;
  int stride;  ///< Of the pictures.
  double size;
};
constexpr std::array<Step, 9> kSteps = {{{{255, 3}, 2, 1.0},
                                         {{192, 6}, 2, 1.0},
                                         {{128, 8}, 2, 1.0},
                                         {{128, 10}, 3, 1.0},
                                         {{96, 12}, 4, 1.0},
                                         {{128, 10}, 3, 0.75},
                                         {{96, 12}, 4, 0.75},
                                         {{64, 14}, 4, 0.5},
                                         {{32, 16}, 6, 0.4}}};

using Entries = std::vector<std::uint8_t>;

bool isNear(const ByteColor& shown, const std::uint8_t* rgb, int tolerance) {
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(int{shown[c]} - int{rgb[c]}) > tolerance) return false;
  return true;
}

/// What is `before` stays where it is near enough.
Entries entriesOf(const renderer::Image& picture, const Palette& palette, const Entries& before,
                  int tolerance) {
  Entries entries;
  entries.reserve(picture.rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
    const std::uint8_t* rgb = &picture.rgb[i];
    const bool stays = !before.empty() && isNear(palette.colors()[before[i / 3]], rgb, tolerance);
    entries.push_back(stays ? before[i / 3] : palette.entryOf(rgb));
  }
  return entries;
}

void append(std::vector<std::uint8_t>& data, std::uint32_t number, std::size_t bytes) {
  const std::size_t begin = data.size();
  data.resize(begin + bytes);
  for (std::size_t i = 0; i < bytes; ++i)
    data[begin + i] = static_cast<std::uint8_t>(number >> (8 * (bytes - 1 - i)) & 0xffu);
}

/// Where a frame's rectangle is.
struct Part {
  int left = 0, top = 0, right = 0, bottom = 0;
};

Part changedPart(const Entries& before, const Entries& now, int width, int height) {
  Part part{width, height, 0, 0};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      if (before[at] == now[at]) continue;
      part.left = std::min(part.left, x), part.right = std::max(part.right, x + 1);
      part.top = std::min(part.top, y), part.bottom = std::max(part.bottom, y + 1);
    }
  return part.right > part.left ? part : Part{0, 0, 1, 1};
}

/// Rows without filters (PNG 1.2, section 6), which help indices nothing; `clear` stands for what stays.
std::vector<std::uint8_t> packedPart(const Entries* before, const Entries& now, const Part& part, int width,
                                     std::uint8_t clear) {
  std::vector<std::uint8_t> rows;
  for (int y = part.top; y < part.bottom; ++y) {
    rows.push_back(0);
    for (int x = part.left; x < part.right; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      rows.push_back(before != nullptr && (*before)[at] == now[at] ? clear : now[at]);
    }
  }
  return renderer::zlibStream(rows);
}

std::vector<std::uint8_t> frameControl(std::uint32_t sequence, const Part& part,
                                       const renderer::FrameDelay& delay, bool is_first) {
  std::vector<std::uint8_t> data;
  append(data, sequence, 4);
  for (const int number : {part.right - part.left, part.bottom - part.top, part.left, part.top})
    append(data, static_cast<std::uint32_t>(number), 4);
  append(data, delay.numerator, 2);
  append(data, delay.denominator, 2);
  data.push_back(0);                 // It stays.
  data.push_back(is_first ? 0 : 1);  // It is put over what is there.
  return data;
}

/// Signature, size, palette with one clear entry behind it.
std::vector<std::uint8_t> headOf(const renderer::Image& picture, const Palette& palette) {
  std::vector<std::uint8_t> bytes, head, colors, clear(palette.colors().size(), 255);
  append(head, static_cast<std::uint32_t>(picture.width), 4);
  append(head, static_cast<std::uint32_t>(picture.height), 4);
  head.insert(head.end(), {8, kIndexed, 0, 0, 0});
  for (const ByteColor& color : palette.colors()) colors.insert(colors.end(), color.begin(), color.end());
  colors.insert(colors.end(), {0, 0, 0});
  clear.push_back(0);
  renderer::appendPngSignature(bytes);
  renderer::appendPngChunk(bytes, {"IHDR", head});
  renderer::appendPngChunk(bytes, {"sRGB", {0}});
  renderer::appendPngChunk(bytes, {"PLTE", colors});
  renderer::appendPngChunk(bytes, {"tRNS", clear});
  return bytes;
}

std::vector<std::uint8_t> stillPng(const renderer::Image& picture) {
  const std::array<renderer::Image, 1> alone = {picture};
  const Palette palette(alone, 255);
  std::vector<std::uint8_t> bytes = headOf(picture, palette);
  const Entries entries = entriesOf(picture, palette, {}, 0);
  renderer::appendPngChunk(
      bytes, {"IDAT", packedPart(nullptr, entries, {0, 0, picture.width, picture.height}, picture.width, 0)});
  renderer::appendPngChunk(bytes, {"IEND", {}});
  return bytes;
}

}  // namespace

std::vector<std::uint8_t> indexedAnimation(std::span<const renderer::Image> pictures,
                                           const renderer::FrameDelay& delay, const Fidelity& fidelity) {
  REQUIRE(!pictures.empty() && fidelity.colors <= 255, pictures.size(), fidelity.colors);
  const Palette palette(pictures, fidelity.colors);
  const auto clear = static_cast<std::uint8_t>(palette.colors().size());
  const int width = pictures[0].width, height = pictures[0].height;
  std::vector<std::uint8_t> bytes = headOf(pictures[0], palette), control;
  append(control, static_cast<std::uint32_t>(pictures.size()), 4);
  append(control, 0, 4);  // for ever
  renderer::appendPngChunk(bytes, {"acTL", control});
  Entries before;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Entries now = entriesOf(pictures[i], palette, before, fidelity.tolerance);
    const bool is_first = i == 0;
    const Part part = is_first ? Part{0, 0, width, height} : changedPart(before, now, width, height);
    renderer::FrameDelay shown = delay;
    if (i + 1 == pictures.size() && pictures.size() > 1)
      shown.numerator = static_cast<std::uint16_t>(std::min(65535, delay.numerator * kLastShown));
    renderer::appendPngChunk(bytes, {"fcTL", frameControl(sequence++, part, shown, is_first)});
    std::vector<std::uint8_t> data;
    if (!is_first) append(data, sequence++, 4);
    const std::vector<std::uint8_t> packed =
        packedPart(is_first ? nullptr : &before, now, part, width, clear);
    data.insert(data.end(), packed.begin(), packed.end());
    renderer::appendPngChunk(bytes, {is_first ? "IDAT" : "fdAT", data});
    before = now;
  }
  renderer::appendPngChunk(bytes, {"IEND", {}});
  return bytes;
}

renderer::Image smaller(const renderer::Image& picture, int width) {
  if (width >= picture.width) return picture;
  const int height =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(picture.height) * width / picture.width)));
  renderer::Image out{width, height, {}};
  out.rgb.reserve(3 * static_cast<std::size_t>(width * height));
  // The whole pixels that a new one covers: sizes here are at least two fifths of the old.
  const auto edge = [](int i, int from, int to) { return static_cast<int>(std::int64_t{i} * from / to); };
  for (int y = 0; y < height; ++y) {
    const int y0 = edge(y, picture.height, height),
              y1 = std::max(y0 + 1, edge(y + 1, picture.height, height));
    for (int x = 0; x < width; ++x) {
      const int x0 = edge(x, picture.width, width), x1 = std::max(x0 + 1, edge(x + 1, picture.width, width));
      std::array<int, 3> sum{};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.pixel(u, v)[c];
      const int count = (y1 - y0) * (x1 - x0);
      for (const int channel : sum)
        out.rgb.push_back(static_cast<std::uint8_t>((channel + count / 2) / count));
    }
  }
  return out;
}

SmallAnimation smallAnimation(const std::vector<renderer::Image>& pictures, double fps,
                              std::size_t most_bytes) {
  REQUIRE(!pictures.empty());
  SmallAnimation made;
  for (const Step& step : kSteps) {
    std::vector<renderer::Image> chosen;
    const int width = std::max(1, static_cast<int>(std::lround(step.size * pictures[0].width)));
    for (std::size_t i = 0; i < pictures.size(); i += static_cast<std::size_t>(step.stride))
      chosen.push_back(smaller(pictures[i], width));
    made.fps = 2.0 * fps / step.stride;
    made.moving = indexedAnimation(chosen, renderer::frameDelay(made.fps), step.fidelity);
    made.width = chosen[0].width;
    made.height = chosen[0].height;
    if (made.moving.size() <= most_bytes) break;
  }
  made.still = stillPng(pictures[0]);
  return made;
}

}  // namespace carom::demos
