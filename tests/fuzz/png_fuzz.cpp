// Feeds random and damaged PNG files to the reader, in one process, to be built with the sanitizers. Every
// file must be decoded or be refused in one line. A failure prints the seed that repeats it alone with
// --count 1.
//
//     cmake --build --preset asan+ubsan --target png_fuzz
//     build/asan+ubsan/tests/png_fuzz --count 100000 --seed 1
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "tests/fuzz/png_mutations.h"

int main(int argc, char** argv) {
  using namespace carom::renderer;
  std::uint64_t count = 100000, seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--count") count = std::strtoull(argv[i + 1], nullptr, 10);
    if (option == "--seed") seed = std::strtoull(argv[i + 1], nullptr, 10);
  }
  std::uint64_t decoded = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    PngMutations mutations(seed + i);
    try {
      const std::string whole = mutations.whole();
      if (fateOf(whole) != PngFate::kDecoded) throw std::logic_error("a whole file is refused");
      decoded += fateOf(mutations.damaged()) == PngFate::kDecoded ? 1 : 0;
    } catch (const std::exception& error) {
      std::cerr << "--count 1 --seed " << seed + i << ": " << error.what() << '\n';
      return 1;
    }
  }
  std::cout << count << " damaged PNG files: " << decoded << " decoded, " << count - decoded << " refused\n";
  return 0;
}
