// One reader, CAROM_FUZZED of tests/fuzz/corpus.h's kinds, as libFuzzer calls it (clang -fsanitize=fuzzer):
// tests/fuzz.sh --libfuzzer builds and runs one for each kind. A recording's checksums are put right after
// each change.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/seed_file.h"

namespace {
using namespace carom::fuzz;
constexpr Kind kFuzzed = Kind::CAROM_FUZZED;
}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t room);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string wrong = wrongWithSeed(kFuzzed, std::string(bytes, bytes + size));
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s: %s\n", nameOf(kFuzzed), wrong.c_str());
  std::abort();
}

/// libFuzzer's own changes, and as many as a stranger makes.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t room,
                                               unsigned seed) {
  Random random(seed);
  if (random.oneIn(2)) size = LLVMFuzzerMutate(bytes, size, room);
  std::string changed(bytes, bytes + size);
  if (kFuzzed == Kind::kRecording)
    changed = mutatedRecording(std::move(changed), changed, random);
  else if (kFuzzed != Kind::kPng && random.oneIn(2))
    changed = mutatedText(std::move(changed), changed, random);
  size = std::min(changed.size(), room);
  std::memcpy(bytes, changed.data(), size);
  return size;
}
