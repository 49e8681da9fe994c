// The program under limits of memory, of processes and of descriptors: every command does its work, or ends
// with one line and 4.
#include <algorithm>
#include <cstdlib>
#include <map>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

const std::map<std::string, std::string>& commands() {
  static const std::string mesh = CAROM_SOURCE_DIR "/assets/meshes/gem.obj";
  static const std::map<std::string, std::string> all{
      {"list", "list"},
      {"check", "check sliding"},
      {"check a mesh", "check " + mesh},
      {"distance", "distance " + mesh + " " + mesh},
      {"simulate", "simulate sliding -q --duration 0.1"},
      {"export", "export sliding -q --duration 0.1 --csv /dev/null"},
      {"render", "render sliding -q --size 32x32 --duration 0.1 -o - --stream rgb24"},
      {"render by workers", "render sliding -q --size 32x32 --duration 0.1 --workers 2 -o - --stream rgb24"},
      {"budget", "budget sliding -q --size 32x32 --duration 0.1 --replays 2 --percentile 50 --budget 100000"},
      {"doctor", "doctor"}};
  return all;
}

/// How `command` ends in a shell that has set `limit`; `as` begins the command line that runs that shell.
ProgramEnd endUnder(const TemporaryFolder& folder, const std::string& limit, const std::string& command,
                    const std::string& as = "") {
  const fs::path err = folder.path() / "err";
  const std::string line = as + " bash -c 'ulimit -c 0; " + limit + "; cd /; exec \"" CAROM_BINARY "\" " +
                           command + "' > /dev/null 2> '" + err.string() + "'";
  const int code = exitCodeOf(std::system(line.c_str()));
  return {code, "", readTextFile(err)};
}

void expectDoneOrOneLine(const ProgramEnd& end) {
  if (end.code != 0) expectOneLine(end, 4);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// A sanitizer's own shadow is larger than any of these.
TEST(Limits, WithTooLittleMemoryEveryCommandEndsWith4AndOneLine) {
  const TemporaryFolder folder;
  int refused = 0;
  for (const auto& [name, command] : commands())
    for (int megabytes = 260; megabytes <= 1100; megabytes += 140) {
      SCOPED_TRACE(name + " within " + std::to_string(megabytes) + " MB");
      const ProgramEnd end = endUnder(folder, "ulimit -v " + std::to_string(1024 * megabytes), command);
      if (end.code == 127) continue;  // too little for the loader: the program has not begun
      expectDoneOrOneLine(end);
      refused += end.code != 0;
    }
  EXPECT_GT(refused, 0);
}
#endif

// The first of them are what the shell has open.
TEST(Limits, WithTooFewDescriptorsEveryCommandEndsWith4AndOneLine) {
  const TemporaryFolder folder;
  int refused = 0;
  for (const auto& [name, command] : commands())
    for (int count = 4; count <= 16; ++count) {
      SCOPED_TRACE(name + " with " + std::to_string(count));
      const ProgramEnd end = endUnder(folder, "ulimit -n " + std::to_string(count), command);
      if (end.code == 127) continue;  // too few for the loader
      expectDoneOrOneLine(end);
      refused += end.code != 0;
    }
  EXPECT_GT(refused, 0);
}

// Root has no such limit, and runs it as nobody. Mesa waits for ever for threads that it did not get.
TEST(Limits, WithoutAnotherProcessEveryCommandDoesItsWorkOrEndsWith4AndOneLine) {
  const std::string as = ::geteuid() == 0
                             ? "timeout -s KILL 60 setpriv --reuid 65534 --regid 65534 --clear-groups"
                             : "timeout -s KILL 60";
  const TemporaryFolder folder;
  if (endUnder(folder, ":", "--version", as).code != 0) GTEST_SKIP() << "nobody cannot run it here";
  int refused = 0;
  for (const auto& [name, command] : commands())
    for (const char* count : {"1", "3", "8"}) {
      SCOPED_TRACE(name + " with " + count);
      const ProgramEnd end = endUnder(folder, std::string("ulimit -u ") + count, command, as);
      expectDoneOrOneLine(end);
      refused += end.code != 0;
    }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace carom::demos
