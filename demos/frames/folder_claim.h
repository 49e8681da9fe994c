#pragma once
// A run's claim on the folder that its frames go to: runs that make the same frames (shards of one run, a run
// resumed beside others) share a folder, any other run is refused while they last. The claim is a lock of the
// system's on the folder itself: nothing is written, and it ends with the process and its workers, however
// they end. Tested in tests/demos/frames/folder_claim_test.cpp, and through the program in
// tests/demos/render/long_jobs_test.cpp.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::demos {

class FolderClaim {
 public:
  struct Claim {
    std::filesystem::path folder;  ///< Empty: the current one. Created when it is not there.
    std::string part;              ///< What of the folder is claimed: claims of other parts never meet.
    std::uint64_t identity = 0;    ///< Of what is made there.
  };

  /// Throws CannotWrite while another process makes something of another identity there. Nothing is refused
  /// where the system cannot lock folders (some network file systems), nor where there can be no such folder,
  /// which whoever writes there will find.
  explicit FolderClaim(const Claim& claim);
  /// Gives the claim up, once workers that were forked meanwhile have ended too; folders that were created
  /// and are still empty go.
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

 private:
  std::vector<std::filesystem::path> created_;  // The deepest first.
  int descriptor_ = -1;
};

}  // namespace carom::demos
