#include "demos/record/csv_file.h"

#include <unistd.h>

#include "demos/scene/written_files.h"

namespace carom::demos {
namespace {

constexpr std::size_t kMostWaiting = 1 << 16;  // Bytes.

}  // namespace

std::string quotedField(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

CsvFile::CsvFile(const std::filesystem::path& path, const char* header) {
  if (path.empty()) return;
  if (path == kStandardOutput)
    pipe_.emplace(STDOUT_FILENO, "standard output");
  else
    file_.emplace(path);
  add(header);
}

void CsvFile::add(const std::string& line) {
  if (file_) {
    file_->write(line + "\n");
    return;
  }
  waiting_ += line + "\n";
  if (waiting_.size() >= kMostWaiting) empty();
}

void CsvFile::empty() {
  pipe_->write({reinterpret_cast<const std::uint8_t*>(waiting_.data()), waiting_.size()});
  waiting_.clear();
}

void CsvFile::commit() {
  if (file_) file_->commit();
  if (pipe_) empty();
}

}  // namespace carom::demos
