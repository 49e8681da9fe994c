#pragma once
// A file that appears whole or not at all: written under a temporary name in the same folder, checked, then
// renamed. A file that is given up (an exception, an interrupt) leaves nothing behind. A link stays a link to
// the file it names; a device or pipe (/dev/stdout, /dev/null) is never replaced but written to. Tested in
// tests/demos/system/atomic_file_test.cpp.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace carom::demos {

/// Deletes what processes that were killed left of files with these names in a folder: temporary files whose
/// process is no longer there.
void removeAbandoned(const std::filesystem::path& folder, const std::set<std::string>& names);

class AtomicFile {
 public:
  /// Creates the folder and the temporary file. Throws CannotWrite.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);
  void write(std::span<const std::uint8_t> bytes);
  /// Checks that every byte arrived and gives the file its name. Throws CannotWrite, leaving an older file as
  /// it was.
  void commit();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path path_;       ///< As it was given, for messages.
  std::filesystem::path target_;     ///< What gets the bytes: `path_`, or the file that it links to.
  std::filesystem::path temporary_;  ///< Empty for a device or pipe, and after commit.
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uintmax_t written_ = 0;
};

}  // namespace carom::demos
