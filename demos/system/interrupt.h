#pragma once
// SIGINT and SIGTERM as a flag that loops look at, so that destructors run and nothing half-written stays
// behind. Tested through the program in tests/demos/program/program_test.cpp.

namespace carom::demos {

/// From now on the first of either signal only raises the flag; a second one ends the program as it would
/// have. To be called where the looking begins: before that, an interrupt ends the program at once and there
/// is nothing to tidy.
void catchInterrupts();

/// Throws Interrupted when a signal has arrived.
void throwIfInterrupted();

}  // namespace carom::demos
