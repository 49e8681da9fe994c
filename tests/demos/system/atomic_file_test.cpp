#include "demos/system/atomic_file.h"

#include <array>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "demos/asset/asset_path.h"
#include "demos/system/exit_code.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thrown_message.h"

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

TEST(AtomicFile, ALinkGoesOnNamingTheFileThatIsReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "data");
  const fs::path file = folder.file("data/run.csv", "old");
  const fs::path link = folder.path() / "latest.csv";
  fs::create_symlink("data/run.csv", link);
  AtomicFile written(link);
  written.write("new");
  EXPECT_EQ(readTextFile(file), "old");
  written.commit();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(readTextFile(file), "new");
  EXPECT_EQ(filesIn(folder.path() / "data"), 1u);
}

// As root, a rename would take /dev/null from the whole machine.
TEST(AtomicFile, APipeOrDeviceIsWrittenToAndStays) {
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  AtomicFile written(pipe);
  written.write("streamed");
  written.commit();
  std::array<char, 16> read_back{};
  EXPECT_EQ(read(reader, read_back.data(), read_back.size()), 8);
  EXPECT_STREQ(read_back.data(), "streamed");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(filesIn(folder.path()), 1u);
}

// Two processes of one number, as in two containers, are told apart by neither's files.
TEST(AtomicFile, TwoOfOneNameDoNotMeet) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "data.csv";
  AtomicFile first(path), second(path);
  first.write("first");
  second.write("second");
  EXPECT_EQ(filesIn(folder.path()), 2u);
  second.commit();
  first.commit();
  EXPECT_EQ(readTextFile(path), "first");
  EXPECT_EQ(filesIn(folder.path()), 1u);
}

TEST(Abandoned, IsWhatNobodyHolds) {
  const TemporaryFolder folder;
  folder.file(".data.csv.77.partial", "of an earlier version");
  folder.file(".data.csv.0123abcd.partial", "half");
  folder.file(".v.0123abcd.partial.mp4", "half");
  folder.file(".other.csv.0123abcd.partial", "of somebody else");
  folder.file(".data.csv.partial", "of nobody");
  const AtomicFile held(folder.path() / "data.csv");
  const TemporaryFile video(folder.path() / "v.mp4", TemporaryFile::Ending::kOfTarget);
  EXPECT_EQ(video.path().extension(), ".mp4");
  EXPECT_EQ(filesIn(folder.path()), 7u);
  removeAbandoned(folder.path(), {"data.csv", "v.mp4"});
  EXPECT_EQ(filesIn(folder.path()), 4u);
  EXPECT_TRUE(fs::exists(video.path()));
  EXPECT_TRUE(fs::exists(folder.path() / ".other.csv.0123abcd.partial"));
  EXPECT_TRUE(fs::exists(folder.path() / ".data.csv.partial"));
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
