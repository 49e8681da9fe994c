#pragma once
// Arithmetic in scene files: "=2*r + 0.1". Numbers, names, + - * / % ^, brackets and a few functions, each
// rounded as IEEE 754 says, so that the same text gives the same bits everywhere; angles are in degrees, and
// their sines have the engine's own bits. Nothing else can be said in it, and its length and depth are
// bounded. Tested in tests/demos/language/scene_expansion_test.cpp.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::demos {

/// The value of a name; none where it is unknown.
using NamedNumber = std::function<std::optional<double>(const std::string& name)>;

/// All names that are known.
using KnownNames = std::function<std::vector<std::string>()>;

/// Throws InputError that says what is wrong, where in the text, and what is accepted; `namesOf` is asked for
/// it only.
double evaluate(std::string_view text, const NamedNumber& numberOf, const KnownNames& namesOf);

/// Whether it is a name as `set` and `for` give them: a letter, then letters, digits and _.
bool isArithmeticName(std::string_view text);
/// What names must not be: the functions and constants.
bool isArithmeticWord(std::string_view name);

}  // namespace carom::demos
