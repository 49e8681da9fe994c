#pragma once
// Life under a limit of memory (ulimit -v, ulimit -d). Our own code throws std::bad_alloc, which becomes a
// line and an exit code; libraries (Mesa and its compiler above all) do not look at what malloc answers: they
// crash, abort or print lines of their own. Where memory is limited, and only there, such an end is told as
// what it is. Tested through the program in tests/demos/program/limits_program_test.cpp.

namespace carom::demos {

/// Where this process has a limit of memory: from now on a fault, abort or exit ends it with one line and
/// ExitCode::kCannotWrite (a child of this process: with the code alone), and of what is written to standard
/// error only what goes through std::cerr arrives. Without a limit it does nothing, and a crash is a crash.
/// To be called once, before other threads are started.
void tellCrashesOfLimitedMemory();

/// The code that `main` returns: from now on an end of the process is the program's own.
int returned(int code);

/// For a bug of ours, which has been told: SIGABRT ends the process as it does everywhere.
[[noreturn]] void abortAsBug();

}  // namespace carom::demos
