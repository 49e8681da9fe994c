#pragma once
// Whole numbers as a stream of bytes that packs well: each as a variable-length integer whose lowest bit is
// the sign, and columns of numbers as their second differences, which are small where motion is smooth and
// zero at rest or at constant speed. The page's reader is web/stream.js. Tested in
// tests/demos/page/byte_stream_test.cpp.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace carom::demos {

/// The farthest that a number may be from zero: JavaScript's numbers hold all whole ones up to 2^53.
inline constexpr std::int64_t kMostWhole = std::int64_t{1} << 51;

class ByteStream {
 public:
  /// Within kMostWhole; what is beyond becomes that.
  void add(std::int64_t number);
  /// Its second differences; the column's length is the reader's to know.
  void addColumn(std::span<const std::int64_t> column);
  /// The length and the bytes.
  void addText(std::string_view text);
  /// What another stream holds.
  void addBytes(std::string_view bytes) { bytes_.append(bytes); }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A positive number by its logarithm, to 0.3 %; 0 and what is below 1e-12 become the least there is.
std::int64_t byLogarithm(double value);

/// A zlib stream (RFC 1950) of the bytes in base64.
std::string packedBase64(std::string_view bytes);

}  // namespace carom::demos
