#pragma once
// Text as it stands in HTML, SVG and XML, between tags and in attributes.
// Tested in tests/demos/report/junit_test.cpp and tests/demos/report/budget_plot_test.cpp.

#include <string>

namespace carom::demos {

/// Control characters, which XML 1.0 cannot hold, become spaces, bytes that are no UTF-8 question marks.
std::string markupText(const std::string& text);

}  // namespace carom::demos
