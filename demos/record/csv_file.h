#pragma once
// A CSV file (RFC 4180) that is written while a run goes on and appears whole or not at all; on standard
// output its rows appear as they come; nothing when no path is given. Tested in
// tests/demos/record/trajectory_files_test.cpp, and through the program in
// tests/demos/program/given_values_program_test.cpp.

#include <filesystem>
#include <optional>
#include <sstream>
#include <string>

#include "demos/system/atomic_file.h"
#include "demos/system/pipe_writer.h"

namespace carom::demos {

/// Seventeen digits give the same bits when read back.
inline std::ostringstream exactRow() {
  std::ostringstream row;
  row.precision(17);
  return row;
}

/// Text as one field of a row, whatever it holds.
std::string quotedField(const std::string& text);

class CsvFile {
 public:
  /// "-" is standard output. Throws CannotWrite, as do the others, and PipeClosed.
  CsvFile(const std::filesystem::path& path, const char* header);
  explicit operator bool() const { return file_.has_value() || pipe_.has_value(); }
  void row(const std::ostringstream& row) { add(row.str()); }
  void commit();

 private:
  void add(const std::string& line);
  void empty();

  std::optional<AtomicFile> file_;
  std::optional<PipeWriter> pipe_;
  std::string waiting_;  ///< Rows on their way to the pipe.
};

}  // namespace carom::demos
