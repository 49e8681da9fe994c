// What may happen to a run from outside, beyond failures_program_test.cpp (devices, pipes, signals) and
// limits_program_test.cpp (memory, processes, descriptors): folders that are not there or cannot be written
// to, a recording that is changed while it is drawn, a clock that jumps, a kill at any moment.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "demos/asset/asset_path.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

const std::string kSmall = "--size 32x32 --duration 0.3";

/// The program in a shell that has said `before` first; its working folder is `folder`.
ProgramEnd endInShell(const TemporaryFolder& folder, const std::string& before,
                      const std::string& arguments) {
  const fs::path out = folder.path() / "told.out", err = folder.path() / "told.err";
  const std::string line = "cd '" + folder.path().string() + "' && bash -c '" + before +
                           " \"" CAROM_BINARY "\" " + arguments + "' > '" + out.string() + "' 2> '" +
                           err.string() + "'";
  const int code = exitCodeOf(std::system(line.c_str()));
  return {code, readTextFile(out), readTextFile(err)};
}

std::ptrdiff_t entriesOf(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

// Nobody has a home: a container's user, a job's. Shaders are then not kept; nothing is written elsewhere.
TEST(Faults, WithoutAHomeOrATemporaryFolderEveryFrameIsAsEver) {
  const TemporaryFolder usual, without;
  const std::string render = "render resting -q " + kSmall + " -o frames/f_####.png";
  ASSERT_EQ(endInShell(usual, "", render).code, 0);
  for (const char* before :
       {"env -u HOME -u XDG_CACHE_HOME", "env HOME=/nonexistent XDG_CACHE_HOME=/nonexistent/cache",
        "env TMPDIR=/nonexistent HOME= XDG_RUNTIME_DIR=/nonexistent", "env -i PATH=/usr/bin:/bin"}) {
    const ProgramEnd end = endInShell(without, before, render);
    EXPECT_EQ(end.code, 0) << before << ": " << end.err;
    EXPECT_TRUE(framesOf(without.path() / "frames") == framesOf(usual.path() / "frames")) << before;
    EXPECT_EQ(entriesOf(without.path()), 3) << before;  // frames, told.out, told.err
    fs::remove_all(without.path() / "frames");
  }
}

// Root may write anywhere, so nobody tries.
TEST(Faults, AFolderThatCannotBeWrittenToEndsWith4AndStaysEmpty) {
  const TemporaryFolder folder;
  const fs::path locked = folder.path() / "locked";
  fs::create_directory(locked);
  fs::permissions(folder.path(), fs::perms::all);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                              fs::perms::others_exec);
  const std::string as = ::geteuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups" : "";
  if (endInShell(folder, as, "check resting").code != 0) GTEST_SKIP() << "nobody cannot read this checkout";
  for (const char* command :
       {"render resting -q -o locked/f_####.png", "simulate resting -q -o locked/run.carom",
        "simulate resting -q --csv locked/run.csv", "export resting locked/m.glb -q",
        "figures -o locked/figures", "budget resting -q --frames 3 --json locked/b.json"}) {
    const bool budget = std::string(command).rfind("budget", 0) == 0;
    const ProgramEnd end =
        endInShell(folder, as,
                   budget ? "budget resting -q --size 32x32 --duration 0.1 --replays 2 --percentile 50 "
                            "--budget 100000 --json locked/b.json"
                          : std::string(command) +
                                (std::string(command).rfind("figures", 0) == 0 ? "" : " --duration 0.2"));
    SCOPED_TRACE(command);
    expectOneLine(end, 4);
    EXPECT_NE(end.err.find("locked"), std::string::npos) << end.err;
    EXPECT_TRUE(fs::is_empty(locked));
  }
  fs::permissions(locked, fs::perms::all);
}

class Drawn : public testing::Test {
 protected:
  /// Draws the recording with `during` called once the first frame is there.
  template <typename During>
  ProgramEnd draw(const fs::path& recording, const During& during) {
    program.emplace(Words{"render", "--from", recording.string(), "-q", "--size", "160x90", "--workers", "1",
                          "-o", "frames/f_####.png"});
    for (int turn = 0; turn < 6000 && !fs::exists(program->folder() / "frames/f_0000.png"); ++turn)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    during();
    return program->wait();
  }
  void simulate(const std::string& scene, const fs::path& recording) {
    const ProgramEnd end = runCarom({"simulate", scene, "-q", "--duration", "3", "-o", recording.string()});
    ASSERT_EQ(end.code, 0) << end.err;
  }
  TemporaryFolder folder;
  std::optional<Program> program;
};

TEST_F(Drawn, ARecordingThatIsReplacedMeanwhileIsDrawnAsItWas) {
  const fs::path recording = folder.path() / "run.carom", other = folder.path() / "other.carom";
  simulate("resting", recording);
  simulate("bouncing-ball", other);
  ASSERT_EQ(draw(recording, [] {}).code, 0);
  const Files undisturbed = framesOf(program->folder() / "frames");
  const ProgramEnd end = draw(recording, [&] { fs::rename(other, recording); });
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(framesOf(program->folder() / "frames") == undisturbed);
}

TEST_F(Drawn, ARecordingThatIsCutShortMeanwhileEndsWith3AndWholeFrames) {
  const fs::path recording = folder.path() / "run.carom";
  simulate("crates-in-a-pool", recording);
  const ProgramEnd end = draw(recording, [&] { fs::resize_file(recording, fs::file_size(recording) / 8); });
  expectOneLine(end, 3);
  EXPECT_NE(end.err.find("the recording is "), std::string::npos) << end.err;
  for (const auto& [name, bytes] : framesOf(program->folder() / "frames")) {
    EXPECT_EQ(name.rfind("f_", 0), 0u) << name;
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << name;
  }
}

// Times that are measured come from the steady clock, and the states from none.
TEST(Faults, AClockThatJumpsChangesNoByte) {
  const TemporaryFolder steady, jumping;
  const std::string render = "render resting --progress json " + kSmall + " -o frames/f_####.png";
  ASSERT_EQ(endInShell(steady, "", render).code, 0);
  const ProgramEnd end = endInShell(jumping, "env LD_PRELOAD=" CAROM_JUMPING_CLOCK, render);
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_TRUE(framesOf(jumping.path() / "frames") == framesOf(steady.path() / "frames"));
  EXPECT_EQ(end.err.find('-'), std::string::npos) << "a time below zero: " << end.err;
}

// In a room of its own, where root may take them away; the frames go where the shell stands.
TEST(Faults, WithAFullSharedMemoryAndNoTemporaryFolderEveryFrameIsAsEver) {
  const TemporaryFolder folder;
  if (std::string(CAROM_BINARY).rfind("/tmp/", 0) == 0) GTEST_SKIP() << "the program itself is in /tmp";
  const std::string render = "render resting -q " + kSmall + " --workers 2 -o - --stream rgb24";
  const ProgramEnd usual = endInShell(folder, "", render);
  ASSERT_EQ(usual.code, 0) << usual.err;
  const std::string room =
      "mount -t tmpfs -o ro none /tmp && mount -t tmpfs -o size=4k none /dev/shm && "
      "head -c 4096 /dev/zero > /dev/shm/full; cd /; ";
  if (std::system(("unshare -m bash -c '" + room + "true' > /dev/null 2>&1").c_str()) != 0)
    GTEST_SKIP() << "no right to a room of its own";
  const fs::path out = folder.path() / "out";
  const std::string line =
      "unshare -m bash -c '" + room + "exec \"" CAROM_BINARY "\" " + render + "' > '" + out.string() + "'";
  EXPECT_EQ(std::system(line.c_str()), 0);
  EXPECT_TRUE(readTextFile(out) == usual.out);
}

// Whenever it is killed, a file is there whole or not at all, and what is left over under another name is
// hidden.
TEST(Faults, AKillAtAnyMomentLeavesTheRecordingWholeOrNotThere) {
  const Words words{"simulate", "resting", "-q", "--duration", "1", "-o", "run.carom", "--csv", "run.csv"};
  const Program undisturbed(words);
  const auto began = std::chrono::steady_clock::now();
  ASSERT_EQ(undisturbed.wait().code, 0);
  const auto length = std::chrono::steady_clock::now() - began;
  const std::string whole = readTextFile(undisturbed.folder() / "run.carom");
  constexpr int kMoments = 12;
  for (int moment = 0; moment < kMoments; ++moment) {
    const Program program(words);
    std::this_thread::sleep_for(length * moment / kMoments);
    program.signal(SIGKILL);
    program.wait();
    const fs::path recording = program.folder() / "run.carom";
    EXPECT_TRUE(!fs::exists(recording) || readTextFile(recording) == whole) << moment;
    for (const auto& entry : fs::directory_iterator(program.folder())) {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(name == "run.carom" || name == "run.csv" || name.front() == '.') << name;
    }
  }
}

}  // namespace
}  // namespace carom::demos
