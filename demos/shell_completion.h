#pragma once
// Completion for bash of commands, options, their fixed values and the shipped scenes' names; `cmake
// --install` puts it where bash-completion looks. Tested in tests/demos/shell_completion_test.cpp.

#include <string>

#include "demos/program_description.h"

namespace carom::demos {

std::string bashCompletion(const ProgramDescription& program);

}  // namespace carom::demos
