#pragma once
// Files to be read: regular ones only. A pipe without a writer would keep the reader waiting for ever, a
// device may have no end, and a folder opens as if it were a file. Tested in
// tests/engine/foundation/input_file_test.cpp.

#include <filesystem>
#include <fstream>
#include <string>

namespace carom {

/// A file opened for reading; where that is impossible the stream is not open and `problem` says why.
struct InputFile {
  std::ifstream stream;
  std::string problem;
};
InputFile tryInputFile(const std::filesystem::path& path);

/// The same; throws InputError "cannot read 'PATH': why" where it cannot be opened.
std::ifstream openInputFile(const std::filesystem::path& path);

}  // namespace carom
