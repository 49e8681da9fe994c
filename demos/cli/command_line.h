#pragma once
// The command line: commands, options, help with an example for each. Only this folder names the option
// library. Tested through the program in tests/demos/program/program_test.cpp.

#include "demos/system/exit_code.h"

namespace carom::demos {

/// Carries out a command line. Throws UsageError for one that makes no sense, and whatever the command
/// throws.
ExitCode runCommandLine(int argc, char** argv);

}  // namespace carom::demos
