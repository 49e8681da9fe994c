#pragma once
// Hands an input to the built program, as a person would.

#include <filesystem>
#include <string>

#include "tests/fuzz/corpus.h"

namespace carom::fuzz {

/// What is wrong with how `program` ended on the input that `file` holds: a code that is not documented, or
/// not exactly one line on standard error. `turn` chooses among the commands that take such a file.
std::string wrongWithProgram(const std::filesystem::path& program, const Input& input,
                             const std::filesystem::path& file, std::uint64_t turn);

}  // namespace carom::fuzz
