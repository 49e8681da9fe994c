// What libFuzzer would call, without it: every file of FOLDER/<kind>/ is taken as it should be, or is named.
//     replay FOLDER            exit code 1: one is not
//     replay --write FOLDER    writes the first seeds there, from files of ours; what is there by another
//     name stays
#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/png_mutations.h"
#include "tests/fuzz/seed_file.h"

namespace {
namespace fs = std::filesystem;
using namespace carom::fuzz;

// Bytes: smaller seeds are changed more often.
constexpr std::size_t kLargestSeed = 6000;
constexpr std::size_t kSeedsOfAKind = 12;

/// One of each kind that the format has, sooner or later.
std::vector<Input> smallPictures() {
  std::vector<Input> pictures;
  for (std::uint64_t seed = 1; seed <= kSeedsOfAKind; ++seed)
    pictures.push_back({Kind::kPng, "picture.png", carom::renderer::PngMutations(seed).whole()});
  return pictures;
}

void write(const fs::path& folder) {
  const Corpus corpus({});
  for (int k = 0; k < kKinds; ++k) {
    const auto kind = static_cast<Kind>(k);
    std::vector<Input> inputs = kind == Kind::kPng ? smallPictures() : corpus.sound(kind);
    // Meshes are a kind of their own, and cutting one into convex pieces again for every change is slow.
    if (kind == Kind::kScene)
      std::erase_if(inputs, [](const Input& i) { return i.bytes.find("\"mesh\"") != std::string::npos; });
    std::stable_sort(inputs.begin(), inputs.end(),
                     [](const Input& a, const Input& b) { return a.bytes.size() < b.bytes.size(); });
    const fs::path place = folder / nameOf(kind);
    fs::create_directories(place);
    for (std::size_t i = 0; i < std::min(inputs.size(), kSeedsOfAKind); ++i)
      if (i < 3 || inputs[i].bytes.size() <= kLargestSeed)
        std::ofstream(place / (std::to_string(i) + "-" + fs::path(inputs[i].name).stem().string()),
                      std::ios::binary)
            << seedOf(inputs[i]);
  }
}

int replay(const fs::path& folder) {
  int seeds = 0, failures = 0;
  for (int k = 0; k < kKinds; ++k) {
    const auto kind = static_cast<Kind>(k);
    for (const auto& entry : fs::directory_iterator(folder / nameOf(kind))) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string wrong = wrongWithSeed(kind, {std::istreambuf_iterator<char>(in), {}});
      ++seeds;
      if (wrong.empty()) continue;
      ++failures;
      std::cout << entry.path().string() << ": " << wrong << '\n';
    }
  }
  std::cout << seeds << " seeds, " << failures << " not taken as they should\n";
  return seeds > 0 && failures == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 1 && words[0] != "--write") return replay(words[0]);
    if (words.size() != 2 || words[0] != "--write") throw std::invalid_argument("replay [--write] FOLDER");
    write(words[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "replay: " << error.what() << '\n';
    return 2;
  }
}
