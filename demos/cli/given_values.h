#pragma once
// The words that a command's options were given, before anything is read: none is empty, and none but text
// goes to standard output. Tested through the program in tests/demos/program/given_values_program_test.cpp.

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "demos/scene/written_files.h"

namespace carom::demos {

/// An empty word is a variable or a pipe of some script that held nothing, and never means "the usual".
/// Throws UsageError, of "--option=" as well.
void refuseEmptyValues(const CLI::App& command, std::span<const std::string> words);

/// The files and folders that the command is to write. Throws UsageError where one is "-" that cannot go to
/// standard output, and where two are one.
std::vector<NamedFile> writtenFiles(const CLI::App& command);

/// The files that it names to be read, but for scenes and what is compared, which know their files better.
std::vector<NamedFile> readFiles(const CLI::App& command);

}  // namespace carom::demos
