#pragma once
// SIGINT and SIGTERM as a flag that loops look at, so that destructors run and nothing half-written stays behind.
// Tested through the program in tests/demos/program_test.cpp.

namespace carom::demos {

/// From now on the two signals only raise the flag.
void catchInterrupts();

/// Throws Interrupted when a signal has arrived.
void throwIfInterrupted();

}  // namespace carom::demos
