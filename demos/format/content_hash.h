#pragma once
// A 64-bit fingerprint of bytes, for telling scenes and frames apart in manifests (not against forgery).
// Multiply-and-fold over little-endian 64-bit words, so that a frame of 720p costs about a millisecond.
// Tested in tests/demos/format/content_hash_test.cpp.

#include <cstddef>
#include <cstdint>
#include <string>

namespace carom::demos {

class ContentHash {
 public:
  /// Adds a block of bytes; the length counts, so that "ab","c" and "a","bc" differ.
  ContentHash& add(const void* bytes, std::size_t count);
  ContentHash& add(const std::string& text) { return add(text.data(), text.size()); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

/// 16 hexadecimal digits.
std::string hexText(std::uint64_t value);

}  // namespace carom::demos
