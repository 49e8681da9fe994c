#include "demos/frames/folder_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "demos/format/content_hash.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

// Locks have places, as if the folder were a file of 2^62 bytes. A part has 2^31 of them, one for each
// identity (cut to as many bits). A run holds a read lock on its identity's place; so can any number, and who
// finds a lock on another place of the part is somebody else. flock, which knows no places and does not meet
// those locks, makes looking and taking one.
constexpr int kBits = 31;
constexpr off_t kPlaces = off_t{1} << kBits;
constexpr int kTurns = 100;  // As often may a folder be removed while it is being opened.
constexpr off_t kAllPlaces = kPlaces * kPlaces;

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

/// The folders of a path that are not there yet, the deepest first.
std::vector<fs::path> missing(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code unknown;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, unknown) && !unknown; at = at.parent_path())
    folders.push_back(at);
  return folders;
}

/// The folder, with nobody else looking; negative where it cannot be made, opened or locked.
int openedAlone(const fs::path& folder) {
  for (int turn = 0; turn < kTurns; ++turn) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return -1;
    struct stat found {};
    if (::flock(descriptor, LOCK_EX) == 0 && ::fstat(descriptor, &found) == 0) {
      if (found.st_nlink > 0) return descriptor;
      ::close(descriptor);  // who had created it has just removed it
      continue;
    }
    ::close(descriptor);
    return -1;
  }
  return -1;
}

}  // namespace

FolderClaim::FolderClaim(const Claim& claim) {
  const fs::path folder = claim.folder.empty() ? fs::path(".") : claim.folder;
  created_ = missing(folder);
  descriptor_ = openedAlone(folder);
  if (descriptor_ < 0) return;
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
  if (descriptor_ < 0) return;
  std::error_code not_empty;
  if (!created_.empty() && ::flock(descriptor_, LOCK_EX) == 0 && !isHeld(descriptor_, {0, kAllPlaces}))
    for (const fs::path& folder : created_)
      if (!fs::remove(folder, not_empty)) break;
  ::close(descriptor_);
}

}  // namespace carom::demos
