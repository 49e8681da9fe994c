#pragma once
// The sound files that the fuzzer changes, by kind, and the input that an index and a seed make of them.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::fuzz {

enum class Kind { kScene, kRecording, kMesh, kPng, kQueries, kWords };
inline constexpr int kKinds = 6;
const char* nameOf(Kind kind);

struct Input {
  Kind kind = Kind::kScene;
  std::string name;  ///< Of a file that holds it: its ending counts.
  std::string bytes;
};

class Corpus {
 public:
  /// Of the assets and golden frames of the source tree; `models` is a folder of more meshes, or empty.
  explicit Corpus(const std::filesystem::path& models);

  /// Every mesh of `models` as it is comes first, whatever its size.
  std::size_t unchangedCount() const { return models_.size(); }
  Input unchanged(std::size_t index) const;
  /// The input of that number, the same for the same seed and files.
  Input mutated(std::uint64_t index, std::uint64_t seed) const;
  const std::vector<Input>& sound(Kind kind) const { return sound_[static_cast<int>(kind)]; }

 private:
  std::vector<std::filesystem::path> models_;
  std::vector<Input> sound_[kKinds];
};

}  // namespace carom::fuzz
