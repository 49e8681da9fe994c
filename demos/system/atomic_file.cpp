#include "demos/system/atomic_file.h"

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <regex>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
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

// Eight digits by chance.
std::string anyWord() {
  std::uint32_t chance = 0;
  if (::getrandom(&chance, sizeof chance, 0) != sizeof chance)
    chance = static_cast<std::uint32_t>(::getpid());
  std::array<char, 9> word{};
  std::snprintf(word.data(), word.size(), "%08" PRIx32, chance);
  return word.data();
}

fs::path temporaryName(const fs::path& target, TemporaryFile::Ending ending) {
  const bool keeps = ending == TemporaryFile::Ending::kOfTarget;
  std::string name = ".";
  name.append((keeps ? target.stem() : target.filename()).string())
      .append(".")
      .append(anyWord())
      .append(".partial");
  if (keeps) name.append(target.extension().string());
  return target.parent_path() / name;
}

// Whether nobody had it, and it is gone.
void removeUnheld(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return;
  std::error_code ignored;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove(path, ignored);
  ::close(descriptor);
}

}  // namespace

void removeAbandoned(const fs::path& folder, const std::set<std::string>& names) {
  static const std::regex temporary("\\.(.+)\\.[0-9a-f]{1,9}\\.partial(\\..+)?");
  std::error_code none;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder.empty() ? fs::path(".") : folder, none)) {
    const std::string name = entry.path().filename().string();
    std::smatch match;
    if (std::regex_match(name, match, temporary) && names.contains(match.str(1) + match.str(2)))
      removeUnheld(entry.path());
  }
}

TemporaryFile::TemporaryFile(const fs::path& target, Ending ending) {
  for (;;) {
    path_ = temporaryName(target, ending);
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) path_.clear();
    if (descriptor_ < 0) return;
    // Before it was locked, another may have taken it for abandoned. Some file systems have no locks.
    struct stat status {};
    if (::flock(descriptor_, LOCK_EX) != 0 || ::fstat(descriptor_, &status) != 0 || status.st_nlink > 0)
      return;
    ::close(descriptor_);
  }
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::error_code TemporaryFile::renameTo(const fs::path& target) {
  std::error_code failed;
  fs::rename(path_, target, failed);
  if (!failed) path_.clear();
  return failed;
}

AtomicFile::AtomicFile(const fs::path& path) : path_(path), target_(path) {
  if (!isDeviceOrPipe(path)) {
    std::error_code failed;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
    if (failed) fail(failed.message());
    target_ = linkedFile(path);
    temporary_.emplace(target_, TemporaryFile::Ending::kPartial);
    if (temporary_->descriptor() < 0) fail(std::strerror(errno));
    const int descriptor = ::fcntl(temporary_->descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor >= 0) file_.reset(::fdopen(descriptor, "wb"));
  } else {
    file_.reset(std::fopen(target_.c_str(), "wb"));
  }
  if (!file_) fail(std::strerror(errno));
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
  if (!temporary_) return;
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(temporary_->path(), failed);
  if (failed) fail(failed.message());
  if (size != written_)
    fail("only " + std::to_string(size) + " of " + std::to_string(written_) + " bytes arrived");
  failed = temporary_->renameTo(target_);
  if (failed) fail(failed.message());
}

void AtomicFile::fail(const std::string& reason) const {
  throw CannotWrite("cannot write " + path_.string() + ": " + reason);
}

}  // namespace carom::demos
