#pragma once
// Completion for bash, zsh and fish of commands, options, their fixed values and the shipped scenes' names;
// `cmake --install` puts each where its shell looks. Tested in tests/demos/cli/shell_completion_test.cpp.

#include <string>

#include "demos/cli/program_description.h"

namespace carom::demos {

std::string bashCompletion(const ProgramDescription& program);
std::string zshCompletion(const ProgramDescription& program);
std::string fishCompletion(const ProgramDescription& program);

}  // namespace carom::demos
