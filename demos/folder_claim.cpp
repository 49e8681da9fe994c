#include "demos/folder_claim.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "demos/content_hash.h"
#include "demos/exit_code.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// Locks have places, as if the folder were a file of 2^62 bytes. A part has 2^31 of them, one for each
// identity (cut to as many bits). A run holds a read lock on its identity's place; so can any number, and who
// finds a lock on another place of the part is somebody else. flock, which knows no places and does not meet
// those locks, makes looking and taking one.
constexpr int kBits = 31;
constexpr off_t kPlaces = off_t{1} << kBits;

off_t cut(std::uint64_t hash) {
  return static_cast<off_t>(hash >> (64 - kBits));
}

struct Range {
  off_t begin = 0;
  off_t size = 0;  // Zero would mean: without end.
};

struct flock lockOf(short kind, const Range& range) {
  struct flock lock {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  lock.l_start = range.begin;
  lock.l_len = range.size;
  return lock;
}

/// Whether somebody else holds a lock there.
bool isHeld(int folder, const Range& range) {
  if (range.size == 0) return false;
  struct flock lock = lockOf(F_WRLCK, range);
  return ::fcntl(folder, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

int opened(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw CannotWrite("cannot write to " + folder.string() + ": " + failed.message());
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // Frames may be written to a folder that may not be read.
  if (descriptor < 0 && errno != EACCES)
    throw CannotWrite("cannot write to " + folder.string() + ": " + std::strerror(errno));
  return descriptor;
}

}  // namespace

FolderClaim::FolderClaim(const Claim& claim) {
  const fs::path folder = claim.folder.empty() ? fs::path(".") : claim.folder;
  descriptor_ = opened(folder);
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0) return;
  const off_t begin = cut(ContentHash().add(claim.part).value()) * kPlaces;
  const off_t place = begin + cut(claim.identity);
  const bool is_foreign = isHeld(descriptor_, {begin, place - begin}) ||
                          isHeld(descriptor_, {place + 1, begin + kPlaces - place - 1});
  if (!is_foreign) {
    struct flock lock = lockOf(F_RDLCK, {place, 1});
    ::fcntl(descriptor_, F_OFD_SETLK, &lock);
  }
  ::flock(descriptor_, LOCK_UN);
  if (!is_foreign) return;
  ::close(descriptor_);
  throw CannotWrite("cannot write to " + folder.string() +
                    ": another carom is writing other frames there; accepted: another folder, or the same "
                    "scene and options (--shard, --frames and --resume may differ)");
}

FolderClaim::~FolderClaim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace carom::demos
