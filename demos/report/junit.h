#pragma once
// JUnit XML, the form in which build servers take test results: a suite with one case a pair of images. A
// pair that does not pass is a failure, one that cannot be read an error. Without times, so that the same
// result gives the same bytes. Tested in tests/demos/report/junit_test.cpp.

#include <string>
#include <vector>

#include "demos/compare/comparison.h"

namespace carom::demos {

/// The suite bears the name `suite`; the cases come in the order given.
std::string junitText(const std::string& suite, const std::vector<Comparison>& comparisons, const Gate& gate);

}  // namespace carom::demos
