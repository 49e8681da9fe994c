#pragma once
// How to write what a person meant: the remedy for a typical mistake in a scene file, from the key that was
// written and its value. The messages of the readers say what is accepted; this says it in the person's own
// terms. Tested in tests/demos/language/scene_mistakes_test.cpp against a list of mistakes.

#include <string>

#include "demos/format/json.h"

namespace carom::demos {

/// "; write ..." for a value that was refused with this message, or nothing.
std::string remedyFor(const Json& value, const std::string& message);

/// The same for a text that is no JSON.
std::string syntaxRemedy(const std::string& message);

}  // namespace carom::demos
