#include "demos/format/base64.h"

#include <algorithm>
#include <string_view>

namespace carom::demos {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  // Three bytes are four digits of six bits; what is lacking at the end becomes '='.
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t present = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i) bits = bits << 8 | (i < present ? bytes[at + i] : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      text.push_back(i <= present ? kDigits[bits >> (18 - 6 * i) & 63u] : '=');
  }
  return text;
}

}  // namespace carom::demos
