#include "demos/frames/folder_claim.h"

#include <csignal>
#include <memory>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/system/exit_code.h"
#include "tests/support/temporary_folder.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t kThis = 0x123456789abcdef0ull, kOther = 0xfedcba9876543210ull;

// Claims of one process are as strange to each other as those of two: a lock belongs to what was opened.
struct ClaimedFolder : testing::Test {
  bool isFree(std::uint64_t identity, const std::string& part = "frames") const {
    try {
      const FolderClaim claim({folder.path(), part, identity});
      return true;
    } catch (const CannotWrite&) {
      return false;
    }
  }
  TemporaryFolder folder;
};

TEST_F(ClaimedFolder, IsSharedByTheSameIdentityAndRefusedToAnyOther) {
  auto first = std::make_unique<FolderClaim>(FolderClaim::Claim{folder.path(), "frames", kThis});
  auto second = std::make_unique<FolderClaim>(FolderClaim::Claim{folder.path(), "frames", kThis});
  for (const std::uint64_t other : {kOther, std::uint64_t{0}, ~std::uint64_t{0}}) EXPECT_FALSE(isFree(other));
  EXPECT_TRUE(isFree(kOther, "still a.png"));
  first.reset();
  EXPECT_FALSE(isFree(kOther));
  EXPECT_TRUE(isFree(kThis));
  second.reset();
  EXPECT_TRUE(isFree(kOther));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST_F(ClaimedFolder, LastsAsLongAsAWorkerAndEndsWithTheKilled) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t run = fork();
  if (run == 0) {
    const FolderClaim claim({folder.path(), "frames", kThis});
    const pid_t worker = fork();
    if (worker != 0 && write(ready[1], &worker, sizeof worker) != sizeof worker) _exit(1);
    for (;;) pause();
  }
  pid_t worker = 0;
  ASSERT_EQ(read(ready[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  EXPECT_FALSE(isFree(kOther));
  kill(run, SIGKILL);
  waitpid(run, nullptr, 0);
  EXPECT_FALSE(isFree(kOther));
  EXPECT_TRUE(isFree(kThis));
  kill(worker, SIGKILL);
  for (int turn = 0; turn < 1000 && !isFree(kOther); ++turn) usleep(10000);
  EXPECT_TRUE(isFree(kOther));
  close(ready[0]);
  close(ready[1]);
}

TEST_F(ClaimedFolder, IsCreatedAndGoesAgainWhenNothingCameIntoIt) {
  const fs::path below = folder.path() / "a/b";
  {
    const FolderClaim claim({below, "frames", kThis});
    EXPECT_TRUE(fs::is_directory(below));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
  {
    const FolderClaim claim({below, "frames", kThis});
    folder.file("a/b/frame.png", "a frame");
  }
  EXPECT_TRUE(fs::exists(below / "frame.png"));
  EXPECT_NO_THROW(FolderClaim({below / "frame.png", "frames", kThis}));
}

}  // namespace
}  // namespace carom::demos
