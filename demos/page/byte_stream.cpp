#include "demos/page/byte_stream.h"

#include <algorithm>
#include <cmath>

#include "demos/format/base64.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

constexpr double kStepsOfOctave = 128.0;  // Half a step is 0.27 %.
constexpr double kLeastShown = 1e-12;

}  // namespace

void ByteStream::add(std::int64_t number) {
  const std::int64_t whole = std::clamp(number, -kMostWhole, kMostWhole);
  std::uint64_t rest = static_cast<std::uint64_t>(std::abs(whole)) * 2 - (whole < 0 ? 1 : 0);
  while (rest >= 0x80) {
    bytes_.push_back(static_cast<char>(0x80 | (rest & 0x7f)));
    rest >>= 7;
  }
  bytes_.push_back(static_cast<char>(rest));
}

void ByteStream::addColumn(std::span<const std::int64_t> column) {
  std::int64_t last = 0, step = 0;
  for (const std::int64_t number : column) {
    const std::int64_t whole = std::clamp(number, -kMostWhole / 4, kMostWhole / 4);
    add(whole - last - step);
    step = whole - last;
    last = whole;
  }
}

void ByteStream::addText(std::string_view text) {
  add(static_cast<std::int64_t>(text.size()));
  bytes_.append(text);
}

std::int64_t byLogarithm(double value) {
  return std::llround(kStepsOfOctave * std::log2(std::max(value, kLeastShown)));
}

std::string packedBase64(std::string_view bytes) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return base64(renderer::zlibStream({data, bytes.size()}));
}

}  // namespace carom::demos
