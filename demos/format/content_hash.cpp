#include "demos/format/content_hash.h"

#include "demos/format/byte_message.h"

namespace carom::demos {
void ContentHash::mix(std::uint64_t word) {
  state_ = (state_ ^ word) *
           0x9e3779b97f4a7c15ull;  // odd, bits of the golden ratio: every input bit reaches the top
  state_ ^= state_ >> 32;          // and from there the bottom
}

ContentHash& ContentHash::add(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  std::size_t done = 0;
  for (; done + 8 <= count; done += 8) mix(littleEndianWord(at + done, 8));  // compiles to one load
  if (done < count) mix(littleEndianWord(at + done, count - done));
  mix(count);
  return *this;
}

std::string hexText(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[(value >> (4 * i)) & 15];
  return text;
}

}  // namespace carom::demos
