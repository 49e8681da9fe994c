#pragma once
// "Did you mean": the valid name that a misspelt one is closest to, by edit distance (Damerau-Levenshtein
// with adjacent transpositions). Tested in tests/demos/format/nearest_name_test.cpp.

#include <span>
#include <string>
#include <string_view>

namespace carom::demos {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`; letters' case is
/// ignored.
int editDistance(std::string_view a, std::string_view b);

/// The candidate closest to `name`, the first of several; empty when none is near enough to be what was
/// meant.
std::string nearestName(std::string_view name, std::span<const std::string> candidates);

/// The tail of an error about `name`: `; did you mean "x"? accepted: a, b, c` (the question only when one is
/// near).
std::string acceptedNames(std::string_view name, std::span<const std::string> candidates);

}  // namespace carom::demos
