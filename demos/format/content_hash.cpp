#include "demos/format/content_hash.h"

#include "demos/format/byte_message.h"

namespace carom::demos {
namespace {

// `state` with a word mixed in.
std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  // Odd, bits of the golden ratio: every input bit reaches the top, and from there the bottom.
  state = (state ^ word) * 0x9e3779b97f4a7c15ull;
  return state ^ (state >> 32);
}

}  // namespace

ContentHash& ContentHash::add(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  std::size_t done = 0;
  std::uint64_t state = state_;  // In a register: through memory, each word of a frame takes twice as long.
  for (; done + 8 <= count; done += 8)
    state = mixed(state, littleEndianWord(at + done, 8));  // compiles to one load
  if (done < count) state = mixed(state, littleEndianWord(at + done, count - done));
  state_ = mixed(state, count);
  return *this;
}

std::string hexText(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) text[15 - i] = "0123456789abcdef"[(value >> (4 * i)) & 15];
  return text;
}

}  // namespace carom::demos
