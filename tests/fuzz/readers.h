#pragma once
// Hands an input to the readers of its kind, as the commands do, within this process.

#include <filesystem>
#include <string>

#include "tests/fuzz/corpus.h"

namespace carom::fuzz {

/// What is wrong with how the input was taken: empty when it was read, or refused by an InputError whose line
/// is one. `file` holds it. A crash ends the process.
std::string wrongWith(const Input& input, const std::filesystem::path& file);

}  // namespace carom::fuzz
