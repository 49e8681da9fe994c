#pragma once
// A CSV file that is written while a run goes on and appears whole or not at all; nothing when no path is
// given. Tested through the program in tests/demos/program/program_test.cpp.

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "demos/system/atomic_file.h"

namespace carom::demos {

/// Seventeen digits give the same bits when read back.
inline std::ostringstream exactRow() {
  std::ostringstream row;
  row.precision(17);
  return row;
}

class CsvFile {
 public:
  /// Throws CannotWrite, as do the others.
  CsvFile(const std::filesystem::path& path, const char* header) {
    if (path.empty()) return;
    file_.emplace(path);
    file_->write(std::string(header) + "\n");
  }
  explicit operator bool() const { return file_.has_value(); }
  void row(const std::ostringstream& row) { file_->write(row.str() + "\n"); }
  void commit() {
    if (file_) file_->commit();
  }

 private:
  std::optional<AtomicFile> file_;
};

}  // namespace carom::demos
