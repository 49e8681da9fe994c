#pragma once
// A file that appears whole or not at all: written under a temporary name in the same folder, checked, then
// renamed. A file that is given up (an exception, an interrupt) leaves nothing behind. A link stays a link to
// the file it names; a device or pipe (/dev/stdout, /dev/null) is never replaced but written to. Whoever
// writes a temporary file holds a lock on it, so that what killed processes left can be told from what others
// are writing, in other containers too, where numbers of processes say nothing. Tested in
// tests/demos/system/atomic_file_test.cpp.

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace carom::demos {

/// Deletes the temporary files of these names in a folder that nobody holds.
void removeAbandoned(const std::filesystem::path& folder, const std::set<std::string>& names);

/// Hidden, and of a name that nobody else has; held as long as this lives, or a process that was forked
/// meanwhile. Goes with this, unless it has been renamed.
class TemporaryFile {
 public:
  /// What its name ends in; some programs choose a format by that.
  enum class Ending : std::uint8_t { kPartial, kOfTarget };

  /// Where it cannot be created `descriptor` is negative, and errno says why.
  TemporaryFile(const std::filesystem::path& target, Ending ending);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Open for writing.
  int descriptor() const { return descriptor_; }
  /// Says why it could not, if so.
  std::error_code renameTo(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;  // empty once it has been renamed
  int descriptor_ = -1;
};

class AtomicFile {
 public:
  /// Creates the folder and the temporary file. Throws CannotWrite.
  explicit AtomicFile(const std::filesystem::path& path);
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

  std::filesystem::path path_;              ///< As it was given, for messages.
  std::filesystem::path target_;            ///< What gets the bytes: `path_`, or the file that it links to.
  std::optional<TemporaryFile> temporary_;  ///< None for a device or pipe.
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uintmax_t written_ = 0;
};

}  // namespace carom::demos
