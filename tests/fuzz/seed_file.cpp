#include "tests/fuzz/seed_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>

#include <unistd.h>

#include "tests/fuzz/readers.h"

namespace carom::fuzz {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestEnding = 8;

/// A folder of this process.
class Scratch {
 public:
  Scratch() : path(fs::temp_directory_path() / ("carom-seeds-" + std::to_string(::getpid()))) {
    fs::create_directories(path);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  const fs::path path;
};

bool isEnding(const std::string& text) {
  return !text.empty() && text.size() <= kLongestEnding &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0; });
}

}  // namespace

std::string seedOf(const Input& input) {
  if (input.kind == Kind::kQueries) {
    static const std::regex kPlace(CAROM_SOURCE_DIR "/");
    return std::regex_replace(input.bytes, kPlace, "");
  }
  if (input.kind != Kind::kMesh) return input.bytes;
  return fs::path(input.name).extension().string().substr(1) + "\n" + input.bytes;
}

Input inputOf(Kind kind, std::string seed) {
  switch (kind) {
    case Kind::kScene:
      return {kind, "scene.json", std::move(seed)};
    case Kind::kRecording:
      return {kind, "run.carom", std::move(seed)};
    case Kind::kPng:
      return {kind, "picture.png", std::move(seed)};
    case Kind::kQueries:
      return {kind, "queries.jsonl", std::move(seed)};
    case Kind::kWords:
      return {kind, "words.txt", std::move(seed)};
    case Kind::kMesh:
      break;
  }
  const std::size_t end = std::min(seed.find('\n'), seed.size());
  std::string ending = seed.substr(0, end);
  if (!isEnding(ending)) ending = "obj";
  return {Kind::kMesh, "mesh." + ending, seed.substr(std::min(end + 1, seed.size()))};
}

std::string wrongWithSeed(Kind kind, const std::string& seed) {
  static const Scratch scratch;
  const Input input = inputOf(kind, seed);
  const fs::path file = scratch.path / input.name;
  std::ofstream(file, std::ios::binary) << input.bytes;
  std::string wrong = wrongWith(input, file);
  fs::remove(file);
  return wrong;
}

}  // namespace carom::fuzz
