#pragma once
// A cause for programs, for the report, and as lines of text. Tested in tests/demos/compare/cause_test.cpp.

#include <string>
#include <vector>

#include "demos/cause/cause_facts.h"
#include "demos/format/json.h"

namespace carom::demos {

enum class CauseDetail { kFacts, kTracks };  ///< kTracks: with the paths of the bodies that moved.
Json causeJson(const Cause& cause, CauseDetail detail);

/// What the headline does not say: since when, the first event, who moved, where it is seen. A line each.
std::vector<std::string> causeLines(const Cause& cause);

}  // namespace carom::demos
