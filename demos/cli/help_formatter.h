#pragma once
// Help in one form, whatever version of CLI11 writes it: later ones begin without "Usage:" and shout the
// headings. Tested in tests/demos/program/program_test.cpp.

#include <memory>

#include <CLI/CLI.hpp>

namespace carom::demos {

std::shared_ptr<CLI::Formatter> helpFormatter();

/// The heading of options that stand under none of their own, of this command and its subcommands.
void headOtherOptions(CLI::App& command);

}  // namespace carom::demos
