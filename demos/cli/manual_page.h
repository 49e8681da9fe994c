#pragma once
// The manual page, carom(1), which `cmake --install` puts where man looks. Tested in
// tests/demos/cli/manual_page_test.cpp.

#include <string>

#include "demos/cli/program_description.h"

namespace carom::demos {

/// In troff with the man macros (man(7)).
std::string manualPage(const ProgramDescription& program);

}  // namespace carom::demos
