#pragma once
// A comparison as JSON, for programs. Tested through the program in
// tests/demos/program/compare_program_test.cpp.

#include <vector>

#include "demos/compare/comparison.h"
#include "demos/compare/golden_update.h"
#include "demos/format/json.h"

namespace carom::demos {

struct ComparisonOutcome {
  const std::vector<Comparison>& comparisons;
  const Gate& gate;
  std::string report;           ///< The report's path; empty when there is none.
  std::vector<Update> updates;  ///< Of each comparison, or empty when nothing was to be updated.
};

/// One object: whether all pass, the gate, the counts, and the pairs in the order of their names.
Json comparisonJson(const ComparisonOutcome& outcome);

}  // namespace carom::demos
