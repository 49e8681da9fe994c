#pragma once
// Values one after another as bytes, for messages between processes of this program: the same build writes
// and reads them, so nothing is converted; and numbers of files, whose bytes have an order of their own.
// Tested in tests/demos/format/byte_message_test.cpp.

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/foundation/contract.h"

namespace carom::demos {

/// The number that a file's bytes are, at most eight, the least first.
inline std::uint64_t littleEndianWord(const void* bytes, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(bytes);
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < count; ++i) word |= static_cast<std::uint64_t>(at[i]) << (8 * i);
  return word;
}

class MessageWriter {
 public:
  template <typename Value>
  requires std::is_arithmetic_v<Value> || std::is_enum_v<Value> MessageWriter& put(Value value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
    return *this;
  }
  /// Not inlined: gcc 12 warns of what it cannot see through where it inlines a whole message.
  [[gnu::noinline]] MessageWriter& put(std::span<const std::uint8_t> bytes) {
    put(bytes.size());
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  MessageWriter& put(const std::string& text) {
    return put(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
  const std::vector<std::uint8_t>& bytes() const& { return bytes_; }
  std::vector<std::uint8_t> bytes() && { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Takes values out in the order in which they were put; more than there is is a bug.
class MessageReader {
 public:
  /// The bytes must outlive this.
  explicit MessageReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <typename Value>
  requires std::is_arithmetic_v<Value> || std::is_enum_v<Value> Value take() {
    Value value{};
    std::memcpy(&value, part(sizeof value).data(), sizeof value);
    return value;
  }
  std::vector<std::uint8_t> takeBytes() {
    const std::span<const std::uint8_t> bytes = part(take<std::size_t>());
    return {bytes.begin(), bytes.end()};
  }
  std::string takeText() {
    const std::span<const std::uint8_t> bytes = part(take<std::size_t>());
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::span<const std::uint8_t> part(std::size_t size) {
    REQUIRE(size <= rest_.size(), size, rest_.size());
    const std::span<const std::uint8_t> first = rest_.first(size);
    rest_ = rest_.subspan(size);
    return first;
  }

  std::span<const std::uint8_t> rest_;
};

}  // namespace carom::demos
