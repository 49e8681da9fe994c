#pragma once
// Inputs as files of bytes alone, for libFuzzer and for the seeds in tests/fuzz/seeds/<kind>/. A mesh's file
// begins with a line that is the ending of its name.

#include <string>

#include "tests/fuzz/corpus.h"

namespace carom::fuzz {

std::string seedOf(const Input& input);
Input inputOf(Kind kind, std::string seed);

/// What is wrong with how the seed is taken, as `wrongWith` says it.
std::string wrongWithSeed(Kind kind, const std::string& seed);

}  // namespace carom::fuzz
