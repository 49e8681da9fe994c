#pragma once
// Reads what a page's streams hold, after the words of demos/page/byte_stream.h: shares no code with the
// writer.

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::demos {

class WholeReader {
 public:
  explicit WholeReader(std::string bytes) : bytes_(std::move(bytes)) {}

  std::int64_t whole() {
    double value = 0.0, factor = 1.0;  // as JavaScript has it
    for (;; factor *= 128.0) {
      if (at_ == bytes_.size()) throw std::runtime_error("the stream is at its end");
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      value += (byte & 127) * factor;
      if (byte < 128) break;
    }
    const double half = std::floor(value / 2.0);
    return static_cast<std::int64_t>(half * 2.0 == value ? half : -half - 1.0);
  }
  std::vector<std::int64_t> column(std::size_t count) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t last = 0, step = 0; numbers.size() < count; numbers.push_back(last))
      last += step += whole();
    return numbers;
  }
  std::vector<std::int64_t> differences(std::size_t count) {
    std::vector<std::int64_t> numbers;
    for (std::int64_t last = 0; numbers.size() < count; numbers.push_back(last)) last += whole();
    return numbers;
  }
  int byte() {
    if (at_ == bytes_.size()) throw std::runtime_error("the stream is at its end");
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  bool atEnd() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace carom::demos
