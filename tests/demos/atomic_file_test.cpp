#include "demos/atomic_file.h"

#include <gtest/gtest.h>

#include "demos/asset_path.h"
#include "demos/exit_code.h"
#include "temporary_folder.h"
#include "thrown_message.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "new" / "data.csv";
  AtomicFile file(path);
  file.write("one,");
  file.write("two\n");
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(readTextFile(path), "one,two\n");
  EXPECT_EQ(filesIn(path.parent_path()), 1u);
}

TEST(AtomicFile, GivenUpLeavesTheOlderFileAndNothingElse) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("data.csv", "old");
  {
    AtomicFile file(path);
    file.write("half of the n");
    EXPECT_EQ(filesIn(folder.path()), 2u);
  }
  EXPECT_EQ(readTextFile(path), "old");
  EXPECT_EQ(filesIn(folder.path()), 1u);
}

TEST(AtomicFile, SaysWhichFileAndWhy) {
  const TemporaryFolder folder;
  const fs::path blocker = folder.file("plain", "not a folder");
  const std::string message = thrownMessage<CannotWrite>([&] { AtomicFile file(blocker / "x.png"); });
  EXPECT_EQ(message, "cannot write " + (blocker / "x.png").string() + ": Not a directory");
}

TEST(AtomicFile, NoticesBytesThatDidNotArrive) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "data.csv";
  AtomicFile file(path);
  file.write("twelve bytes");
  // Another, shorter file takes the place of the temporary one.
  const fs::path temporary = fs::directory_iterator(folder.path())->path();
  fs::remove(temporary);
  folder.file(temporary.filename().string(), "short");
  EXPECT_EQ(thrownMessage<CannotWrite>([&] { file.commit(); }),
            "cannot write " + path.string() + ": only 5 of 12 bytes arrived");
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace carom::demos
