#include "demos/system/atomic_file.h"

#include <cerrno>
#include <cstring>

#include <csignal>
#include <regex>

#include <unistd.h>

#include "demos/system/exit_code.h"

namespace carom::demos {
namespace fs = std::filesystem;

namespace {

/// Whether writing there and renaming would put a file in the place of something that is none.
bool isDeviceOrPipe(const fs::path& path) {
  std::error_code unknown;
  const fs::file_type type = fs::status(path, unknown).type();
  return type == fs::file_type::character || type == fs::file_type::block || type == fs::file_type::fifo;
}

/// The file that a link names; any other path as it is.
fs::path linkedFile(const fs::path& path) {
  std::error_code unknown;
  if (!fs::is_symlink(path, unknown)) return path;
  const fs::path file = fs::canonical(path, unknown);
  return unknown ? path : file;
}

}  // namespace

void removeAbandoned(const fs::path& folder, const std::set<std::string>& names) {
  static const std::regex temporary("\\.(.+)\\.([0-9]{1,9})\\.partial");
  std::error_code none;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder.empty() ? fs::path(".") : folder, none)) {
    const std::string name = entry.path().filename().string();
    std::smatch match;
    if (!std::regex_match(name, match, temporary) || !names.contains(match[1])) continue;
    const bool is_gone = ::kill(std::stoi(match[2]), 0) != 0 && errno == ESRCH;
    std::error_code ignored;
    if (is_gone) fs::remove(entry.path(), ignored);
  }
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path), target_(path) {
  if (!isDeviceOrPipe(path)) {
    std::error_code failed;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
    if (failed) fail(failed.message());
    target_ = linkedFile(path);
    std::string name = ".";  // hidden, and of this process alone
    name.append(target_.filename().string())
        .append(".")
        .append(std::to_string(::getpid()))
        .append(".partial");
    temporary_ = target_.parent_path() / name;
  }
  file_.reset(std::fopen((temporary_.empty() ? target_ : temporary_).c_str(), "wb"));
  if (!file_) fail(std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  file_.reset();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(std::strerror(errno));
  written_ += text.size();
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  write(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void AtomicFile::commit() {
  if (std::fclose(file_.release()) != 0) fail(std::strerror(errno));
  if (temporary_.empty()) return;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(temporary_, failed);
  if (failed) fail(failed.message());
  if (size != written_)
    fail("only " + std::to_string(size) + " of " + std::to_string(written_) + " bytes arrived");
  fs::rename(temporary_, target_, failed);
  if (failed) fail(failed.message());
  temporary_.clear();
}

void AtomicFile::fail(const std::string& reason) const {
  throw CannotWrite("cannot write " + path_.string() + ": " + reason);
}

}  // namespace carom::demos
