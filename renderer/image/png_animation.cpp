#include "renderer/image/png_animation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

/// A part of a picture, pixels; `right` and `bottom` are beyond it.
struct Part {
  int left = 0, top = 0, right = 0, bottom = 0;
};

bool sameRow(const Image& a, const Image& b, int y) {
  return std::memcmp(a.pixel(0, y), b.pixel(0, y), 3 * static_cast<std::size_t>(a.width)) == 0;
}

bool sameColumn(const Image& a, const Image& b, int x, const Part& rows) {
  for (int y = rows.top; y < rows.bottom; ++y)
    if (std::memcmp(a.pixel(x, y), b.pixel(x, y), 3) != 0) return false;
  return true;
}

/// The smallest part outside of which two pictures are equal; of equal ones one pixel, for no frame is empty.
Part changedPart(const Image& before, const Image& now) {
  Part part{0, 0, now.width, now.height};
  while (part.top < part.bottom && sameRow(before, now, part.top)) ++part.top;
  if (part.top == part.bottom) return {0, 0, 1, 1};
  while (sameRow(before, now, part.bottom - 1)) --part.bottom;
  while (sameColumn(before, now, part.left, part)) ++part.left;
  while (sameColumn(before, now, part.right - 1, part)) --part.right;
  return part;
}

Image cutOut(const Image& image, const Part& part) {
  Image cut{part.right - part.left, part.bottom - part.top, {}};
  for (int y = part.top; y < part.bottom; ++y)
    cut.rgb.insert(cut.rgb.end(), image.pixel(part.left, y), image.pixel(part.left, y) + 3 * cut.width);
  return cut;
}

void append32(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (const unsigned shift : {24u, 16u, 8u, 0u})
    bytes.push_back(static_cast<std::uint8_t>(number >> shift & 0xffu));
}

void append16(std::vector<std::uint8_t>& bytes, std::uint16_t number) {
  bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  bytes.push_back(static_cast<std::uint8_t>(number & 0xff));
}

/// acTL: how many frames, and 0: for ever.
std::vector<std::uint8_t> animationControl(int frames) {
  std::vector<std::uint8_t> data;
  append32(data, static_cast<std::uint32_t>(frames));
  append32(data, 0);
  return data;
}

/// fcTL: where the frame's part lies and how long it is shown; it takes the place of what is there.
std::vector<std::uint8_t> frameControl(std::uint32_t sequence, const Part& part, const FrameDelay& delay) {
  std::vector<std::uint8_t> data;
  append32(data, sequence);
  for (const int number : {part.right - part.left, part.bottom - part.top, part.left, part.top})
    append32(data, static_cast<std::uint32_t>(number));
  append16(data, delay.numerator);
  append16(data, delay.denominator);
  data.insert(data.end(), {0, 0});
  return data;
}

}  // namespace

FrameDelay frameDelay(double fps) {
  constexpr int kMost = 65535;
  FrameDelay best{kMost, 1};
  double best_error = std::abs(1.0 - kMost * fps);
  for (int denominator = 1; denominator <= kMost; ++denominator) {
    const double numerator = std::floor(denominator / fps + 0.5);
    if (numerator < 1.0 || numerator > kMost) continue;
    const double error = std::abs(1.0 - numerator * fps / denominator);
    if (error >= best_error) continue;
    best_error = error;
    best = {static_cast<std::uint16_t>(numerator), static_cast<std::uint16_t>(denominator)};
  }
  return best;
}

PngAnimation::PngAnimation(int frames, const FrameDelay& delay, PngText text)
    : frames_(frames), delay_(delay), text_(std::move(text)) {
  REQUIRE(frames > 0, frames);
}

std::vector<std::uint8_t> PngAnimation::add(const Image& image) {
  REQUIRE(added_ < frames_, added_, frames_);
  const bool is_first = added_ == 0;
  REQUIRE(is_first || (image.width == last_.width && image.height == last_.height), image.width,
          image.height);
  const Part part = is_first ? Part{0, 0, image.width, image.height} : changedPart(last_, image);
  const std::vector<PngChunk> chunks =
      pngChunks(encodeSmallPng(cutOut(image, part), is_first ? text_ : PngText{}));
  ++added_;
  std::vector<std::uint8_t> bytes;
  if (is_first) appendPngSignature(bytes);
  bool has_control = false;
  for (const PngChunk& chunk : chunks) {
    const bool is_data = chunk.kind == "IDAT";
    if (is_data && !has_control) {
      if (is_first) appendPngChunk(bytes, {"acTL", animationControl(frames_)});
      appendPngChunk(bytes, {"fcTL", frameControl(sequence_++, part, delay_)});
      has_control = true;
    }
    if (is_data && !is_first) {
      PngChunk data{"fdAT", {}};
      append32(data.data, sequence_++);
      data.data.insert(data.data.end(), chunk.data.begin(), chunk.data.end());
      appendPngChunk(bytes, data);
    } else if (chunk.kind == "IEND" ? added_ == frames_ : is_first) {
      appendPngChunk(bytes, chunk);
    }
  }
  last_ = image;
  return bytes;
}

}  // namespace carom::renderer
