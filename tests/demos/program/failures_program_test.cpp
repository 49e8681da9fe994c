// Each documented exit code through the program, under what brings it about: a full disk, a device that takes
// nothing, standard output closed or without a reader, no renderer, a run whose numbers give out, signals.
#include <algorithm>
#include <cstdlib>
#include <map>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

bool isCharacterDevice(const char* path) {
  return fs::is_character_file(path);
}

struct Failures : testing::Test {
  TemporaryFolder folder;
  std::string mesh = std::string(CAROM_SOURCE_DIR) + "/assets/meshes/gem.obj";
  std::string actual = writePng(folder.path() / "actual/a.png", flatRaster(40, 30, 90)).string();
  std::string golden = writePng(folder.path() / "golden/a.png", flatRaster(40, 30, 190)).string();
  std::string queries =
      folder.file("queries.jsonl", "{\"a\":\"" + mesh + "\",\"b\":\"" + mesh + "\"}\n").string();

  /// Every command with what makes it quick.
  std::map<std::string, Words> commands() const {
    return {{"list", {"list", "--json"}},
            {"check", {"check", "sliding"}},
            {"render", {"render", "sliding", "--progress=none", "--size", "32x32", "--duration", "0.1"}},
            {"simulate", {"simulate", "sliding", "-q", "--duration", "0.1"}},
            {"export", {"export", "sliding", "--progress=none", "--duration", "0.1", "--csv", "-"}},
            {"distance", {"distance", mesh, mesh}},
            {"distance --batch", {"distance", "--batch", queries}},
            {"compare", {"compare", golden, golden, "-q", "--json"}},
            {"budget", budget()},
            {"doctor", {"doctor"}},
            {"--help", {"--help"}},
            {"--version", {"--version"}}};
  }
  static Words budget(const Words& more = {}) {
    Words words{"budget",    "sliding", "-q",           "--size", "32x32",    "--duration", "0.1",
                "--replays", "2",       "--percentile", "50",     "--budget", "100000"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

TEST_F(Failures, EveryCommandEndsWith4WhereItsOutputFindsNoSpace) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  for (const auto& [name, words] : commands()) {
    SCOPED_TRACE(name);
    expectOneLine(Program(words, {}, {full}).wait(), 4, "cannot write to standard output");
  }
  close(full);
}

// A pipe without a writer would keep its reader waiting for ever.
TEST_F(Failures, EveryFileThatIsAPipeADeviceOrALinkToItselfEndsWith3AtOnce) {
  const fs::path pipe = folder.path() / "pipe", link = folder.path() / "link";
  for (const char* kind : {"", ".json", ".obj", ".png", ".carom"}) {
    ASSERT_EQ(mkfifo((pipe.string() + kind).c_str(), 0600), 0);
    fs::create_symlink(link.string() + kind, link.string() + kind);
    fs::create_symlink("/dev/zero", (folder.path() / "zero").string() + kind);
  }
  for (const std::string& path : {pipe.string(), link.string(), (folder.path() / "zero").string()}) {
    for (const Words& words : {Words{"check", path + ".json"},
                               {"check", path + ".obj"},
                               {"render", path + ".json"},
                               {"render", "drop-mesh", "--mesh", path + ".obj"},
                               {"render", "--from", path + ".carom"},
                               {"simulate", path + ".json"},
                               {"export", path + ".carom", "a.glb"},
                               {"distance", path + ".obj", mesh},
                               {"distance", "--batch", path},
                               {"compare", path + ".png", golden, "-q", "--report", "none"},
                               {"compare", golden, path + ".png", "-q", "--report", "none"},
                               budget({"--baseline", path + ".json"})}) {
      SCOPED_TRACE(words[0] + ' ' + words[1]);
      expectOneLine(runCarom(words), 3, path);
    }
  }
}

TEST_F(Failures, EveryCommandEndsWith4WhereStandardOutputIsClosed) {
  for (const auto& [name, words] : commands()) {
    SCOPED_TRACE(name);
    expectOneLine(Program(words, {}, {Outlet::kClosed}).wait(), 4, "cannot write to standard output");
  }
}

// As under a service manager: no file gets the number of the closed descriptor, and with it what is told.
TEST_F(Failures, AClosedStandardErrorChangesNoFile) {
  const auto written = [this](const std::string& name, const std::string& telling) {
    const fs::path run = folder.path() / name;
    fs::create_directory(run);
    const std::string line = "cd '" + run.string() +
                             "'; exec '" CAROM_BINARY
                             "' simulate sliding --duration 1 -o run.carom --csv run.csv --audit audit.csv "
                             "> out " +
                             telling;
    EXPECT_EQ(std::system(line.c_str()), 0) << telling;
    std::string all;
    for (const char* file : {"out", "run.carom", "run.csv", "audit.csv"})
      if (fs::exists(run / file)) all += readTextFile(run / file);
    return all;
  };
  EXPECT_TRUE(written("closed", "--progress json 2>&-") == written("quiet", "-q"));
}

TEST_F(Failures, EveryCommandEndsWith141WhereNobodyReads) {
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  close(ends[0]);
  for (const auto& [name, words] : commands())
    EXPECT_EQ(Program(words, {}, {ends[1]}).wait().code, 128 + SIGPIPE) << name;
  close(ends[1]);
}

// Devices stay devices, whoever runs this.
TEST_F(Failures, EveryFileEndsWith4OnAFullDevice) {
  ASSERT_TRUE(isCharacterDevice("/dev/full"));
  const Words simulate{"simulate", "sliding", "-q", "--duration", "0.1"};
  const Words compare{"compare", actual, golden, "-q"};
  const auto with = [](Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  for (const Words& words :
       {with(simulate, {"--csv", "/dev/full"}), with(simulate, {"--audit", "/dev/full"}),
        with(simulate, {"-o", "/dev/full"}), Words{"export", "sliding", "-q", "--csv", "/dev/full"},
        with(compare, {"--report", "/dev/full"}), with(compare, {"--junit", "/dev/full", "--report", "none"}),
        budget({"--json", "/dev/full"}), budget({"--csv", "/dev/full"}), budget({"--trace", "/dev/full"})}) {
    SCOPED_TRACE(words[0] + " " + words[words.size() - 2]);
    expectOneLine(runCarom(words), 4, "cannot write /dev/full: No space left on device");
    ASSERT_TRUE(isCharacterDevice("/dev/full"));
  }
  EXPECT_EQ(runCarom(with(simulate, {"--csv", "/dev/null"})).code, 0);
  EXPECT_TRUE(isCharacterDevice("/dev/null"));
  const ProgramEnd through = runCarom(with(simulate, {"--csv", "/dev/stdout"}));
  EXPECT_EQ(through.code, 0) << through.err;
}

/// A shell in a namespace of its own, where `disk` is a file system of 64 kB.
ProgramEnd onSmallDisk(const TemporaryFolder& folder, const std::string& script) {
  const fs::path file = folder.file("script.sh", "set -e\nexec > /dev/null\ncd '" + folder.path().string() +
                                                     "'\nmkdir -p disk\n"
                                                     "mount -t tmpfs -o size=64k none disk || exit 77\n" +
                                                     script);
  const std::string line = "unshare --mount --map-root-user sh '" + file.string() + "' 2> '" +
                           (folder.path() / "err").string() + "' || unshare --mount sh '" + file.string() +
                           "' 2> '" + (folder.path() / "err").string() + "'";
  const int code = exitCodeOf(std::system(line.c_str()));
  return {code, "", readTextFile(folder.path() / "err")};
}

TEST_F(Failures, ADiskThatFillsUpLeavesWholeFramesAndResumesWhenThereIsSpace) {
  const std::string render = "'" CAROM_BINARY "' render sliding -q --size 128x72 --fps 10 --duration 2 -o ";
  const ProgramEnd end = onSmallDisk(folder, "set +e\n" + render +
                                                 "disk/f_%04d.png; echo $? > full.code\n"
                                                 "cp -r disk left\nset -e\nmount -o remount,size=16m disk\n" +
                                                 render + "disk/f_%04d.png --resume\ncp -r disk resumed\n" +
                                                 render + "single/f_%04d.png\n");
  if (!fs::exists(folder.path() / "full.code")) GTEST_SKIP() << "no right to mount: " << end.err;
  ASSERT_EQ(end.code, 0) << end.err;
  expectOneLine({std::stoi(readTextFile(folder.path() / "full.code")), "", end.err}, 4,
                ".png: No space left on device");
  const auto frames = [this](const std::string& name) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder.path() / name))
      if (entry.path().extension() != ".json")
        files[entry.path().filename().string()] = readTextFile(entry.path());
    return files;
  };
  const std::map<std::string, std::string> single = frames("single"), left = frames("left");
  ASSERT_EQ(single.size(), 20u);
  EXPECT_GE(left.size(), 1u);
  EXPECT_LT(left.size(), 20u);
  for (const auto& [name, bytes] : left)
    EXPECT_TRUE(single.contains(name) && single.at(name) == bytes) << name;
  EXPECT_EQ(frames("resumed"), single);
}

TEST_F(Failures, AGoldenFileThatFindsNoSpaceKeepsItsOldContent) {
  const std::string before = readTextFile(golden);
  const fs::path big = writePng(folder.path() / "big.png", [] {
    renderer::Raster noise = flatRaster(200, 200, 0);
    unsigned value = 1;
    for (std::uint16_t& sample : noise.samples)
      sample = static_cast<std::uint16_t>((value = value * 1103515245u + 12345u) >> 24);
    return noise;
  }());
  const std::string line = "ulimit -f 8; exec '" CAROM_BINARY "' compare '" + big.string() + "' '" + golden +
                           "' -q --update --report none > /dev/null 2> '" + (folder.path() / "err").string() +
                           "'";
  const int code = exitCodeOf(std::system(line.c_str()));
  expectOneLine({code, "", readTextFile(folder.path() / "err")}, 4, "a.png: File too large");
  EXPECT_EQ(readTextFile(golden), before);
}

// The largest torque on a grain as light as a body can be.
TEST_F(Failures, ARunWhoseNumbersGiveOutEndsWith5AndSaysWhenAndWhose) {
  const std::string scene =
      folder
          .file("grain.json",
                "{ \"format\": 1, \"rate\": 100, \"duration\": 1, \"bodies\": [ { \"name\": \"grain\", "
                "\"mass\": 1e-18, "
                "\"shape\": { \"box\": [1e-4, 1e-4, 1e-4] }, \"torque\": [1e12, 1e12, 0] } ] }")
          .string();
  const std::string where = "the simulation is invalid after step ",
                    what = "the state of \"grain\" is not finite";
  const ProgramEnd end = runCarom({"simulate", scene, "-q", "-o", "run.carom"});
  expectOneLine(end, 5, where);
  EXPECT_NE(end.err.find(what), std::string::npos) << end.err;
  const Program render({"render", scene, "-q", "--size", "32x32", "--fps", "10"});
  expectOneLine(render.wait(), 5, where);
}

TEST_F(Failures, NoRendererEndsWith6AndLeavesNothing) {
  for (const Words& words : {commands().at("render"), commands().at("budget"), Words{"doctor"}}) {
    const Program without(words, {"MESA_GL_VERSION_OVERRIDE=2.1"});
    expectOneLine(without.wait(), 6, "EGL offers no OpenGL core context here");
    EXPECT_TRUE(fs::is_empty(without.folder()));
    const Program slow(words, {"GALLIUM_DRIVER=softpipe"});
    expectOneLine(slow.wait(), 6, "softpipe");
    EXPECT_TRUE(fs::is_empty(slow.folder()));
  }
  EXPECT_EQ(runCarom(commands().at("simulate"), {"MESA_GL_VERSION_OVERRIDE=2.1"}).code, 0);
}

TEST_F(Failures, ASignalEndsEveryLongCommandWith128MoreAndLeavesNothingPartial) {
  const Words budget{"budget", "fifty-bodies", "-q",     "--duration", "600",
                     "--size", "32x32",        "--json", "b.json"};
  const Words simulate{"simulate", "fifty-bodies", "-q",    "--duration", "3000",
                       "-o",       "run.carom",    "--csv", "run.csv"};
  const Words export_motion{"export", "fifty-bodies", "m.glb", "-q", "--duration", "3000"};
  for (const Words& words : {budget, simulate, export_motion})
    for (const int number : {SIGINT, SIGTERM}) {
      SCOPED_TRACE(words[0]);
      const Program program(words);
      program.awaitHandler(number);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      program.signal(number);
      expectOneLine(program.wait(), 128 + number, "interrupted");
      EXPECT_TRUE(fs::is_empty(program.folder()));
    }
}

}  // namespace
}  // namespace carom::demos
