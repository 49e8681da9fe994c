#pragma once
// Files as strangers write them: a sound one with a few things wrong. Text has numbers, strings and whole
// values exchanged, anything has bytes changed, cut, doubled and spliced; recordings have their checksums put
// right again, so that what they guard is reached. All follow a seed and nothing else.

#include <cstdint>
#include <string>

namespace carom::fuzz {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}
  std::uint64_t next();
  /// Below `count`, which is not 0.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  bool oneIn(std::size_t count) { return below(count) == 0; }

 private:
  std::uint64_t state_;
};

/// `other` is another sound file of the kind, to take pieces from.
std::string mutatedText(std::string text, const std::string& other, Random& random);
std::string mutatedBytes(std::string bytes, const std::string& other, Random& random);
std::string mutatedRecording(std::string bytes, const std::string& other, Random& random);

}  // namespace carom::fuzz
