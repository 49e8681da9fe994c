// What options are given, through the program: empty words, standard output, and files that are read or
// written twice.
#include <fstream>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

using Words = std::vector<std::string>;

constexpr char kCrate[] = R"({ "format": 1, "duration": 0.1, "bodies": [
  { "name": "floor", "shape": { "box": [20, 20, 1] }, "position": [0, 0, -0.5], "static": true },
  { "name": "crate", "shape": { "box": [1, 1, 1] }, "position": [0, 0, 3] } ] })";

struct GivenValues : testing::Test {
  TemporaryFolder folder;
  fs::path scene = folder.file("o.json", kCrate);

  std::string at(const std::string& name) const { return (folder.path() / name).string(); }
  static void expectUsage(const Words& words, const std::string& part) {
    SCOPED_TRACE(testing::PrintToString(words));
    expectOneLine(runCarom(words), 2, part);
  }
  static int linesOf(const std::string& text) {
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }
};

TEST_F(GivenValues, AreNotEmpty) {
  const std::string file = scene.string();
  for (const char* option : {"--frames", "--size", "--camera", "--overlay", "-o", "--shard", "--sheet",
                             "--light", "--fps", "--mesh", "--set", "--from", "--ffmpeg"})
    expectUsage({"render", file, option, ""}, std::string("render: ") + option + " is empty");
  for (const char* option : {"--expect-hash", "--csv", "-o", "--audit", "--npy", "--seed"})
    expectUsage({"simulate", file, option, ""}, std::string("simulate: ") + option + " is empty");
  for (const char* option : {"--junit", "--report", "--differences", "--accept", "--mask"})
    expectUsage({"compare", "a", "b", option, ""}, std::string("compare: ") + option + " is empty");
  expectUsage({"budget", file, "--against", ""}, "budget: --against is empty");
  expectUsage({"distance", "a.obj", "b.obj", "--pose-b", ""}, "distance: --pose-b is empty");
  expectUsage({"gallery", file, "-o", ""}, "gallery: -o is empty");
  expectUsage({"simulate", ""}, "simulate: SCENE is empty");
  expectUsage({"simulate", "--expect-hash=", file}, "simulate: --expect-hash is empty");
}

TEST_F(GivenValues, AfterTwoDashesAreNoOptions) {
  const Program program({"check", "--", "-o.json"});
  fs::copy_file(scene, program.folder() / "-o.json");
  EXPECT_EQ(program.wait().code, 0);
  expectUsage({"simulate", "--", "sliding", "-q"}, "simulate: unknown option -q");
}

TEST_F(GivenValues, NameNoFileToWriteThatIsRead) {
  const std::string file = scene.string();
  for (const Words& words : std::vector<Words>{{"simulate", file, "-q", "-o", file},
                                               {"simulate", file, "-q", "--csv", file},
                                               {"simulate", file, "-q", "--audit", file},
                                               {"budget", file, "--json", file},
                                               {"export", file, "--csv", file}})
    expectUsage(words, file + ": the scene is read from there");
  EXPECT_EQ(readTextFile(scene), kCrate);

  ASSERT_EQ(runCarom({"simulate", file, "-q", "-o", at("run.carom")}).code, 0);
  const std::string recording = readTextFile(at("run.carom"));
  expectUsage({"export", at("run.carom"), "--csv", at("run.carom")}, "the recording is read from there");
  EXPECT_EQ(readTextFile(at("run.carom")), recording);

  folder.file("old.json", "{}");
  expectUsage({"budget", file, "--baseline", at("old.json"), "--json", at("old.json")},
              "--baseline is read from there");
}

TEST_F(GivenValues, NameNoComparedPictureToWrite) {
  const renderer::Raster picture = flatRaster(8, 6, 9);
  for (const char* name : {"a/f.png", "b/f.png"}) writePng(at(name), picture);
  const std::string before = readTextFile(at("a/f.png"));
  expectUsage({"compare", at("a"), at("b"), "--report", at("a/f.png")}, "ACTUAL is read from there");
  expectUsage({"compare", at("a"), at("b"), "--junit", at("b/f.png")}, "GOLDEN is read from there");
  expectUsage({"compare", at("a/f.png"), at("b/f.png"), "--differences", at("b")},
              "GOLDEN is read from there");
  EXPECT_EQ(readTextFile(at("a/f.png")), before);
  EXPECT_EQ(runCarom({"compare", at("a"), at("b"), "-q", "--report", at("a/report.html")}).code, 0);
}

TEST_F(GivenValues, NameNoFolderOfGoldenFramesToDrawIn) {
  fs::create_directories(at("suite/o"));
  folder.file("suite/suite.json", R"({ "scenes": [ { "name": "o", "scene": "../o.json" } ] })");
  folder.file("suite/o/frame_0000.png", "golden");
  expectUsage({"regress", at("suite"), "-o", at("suite")}, "the suite is read from there");
  EXPECT_EQ(readTextFile(at("suite/o/frame_0000.png")), "golden");
}

TEST_F(GivenValues, NameEachFileToWriteOnce) {
  const std::string file = scene.string(), out = at("x.csv");
  expectUsage({"simulate", file, "-q", "--csv", out, "--audit", out}, "given twice");
  expectUsage({"simulate", file, "-q", "--csv", out, "-o", out}, "given twice");
  expectUsage({"export", file, at("x.glb"), "--csv", at("x.glb")}, "given twice");
  expectUsage({"simulate", file, "-q", "--csv", "-", "--audit", "-"}, "given twice");
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(GivenValues, OfADashAreStandardOutputWhereThatIsText) {
  const std::string file = scene.string();
  // 3 frames at 30 fps of 0.1 s, two bodies; 24 steps.
  const Program simulated({"simulate", file, "--progress", "none", "--csv", "-"});
  const ProgramEnd trajectory = simulated.wait();
  EXPECT_EQ(trajectory.code, 0) << trajectory.err;
  EXPECT_EQ(trajectory.out.rfind("frame,time_s,body", 0), 0u) << trajectory.out;
  EXPECT_EQ(linesOf(trajectory.out), 1 + 3 * 2);
  EXPECT_NE(trajectory.err.find("steps=24"), std::string::npos) << trajectory.err;
  EXPECT_TRUE(fs::is_empty(simulated.folder()));
  const ProgramEnd audit = runCarom({"simulate", file, "-q", "--audit", "-"});
  EXPECT_EQ(linesOf(audit.out), 1 + 24);
  EXPECT_EQ(audit.err, "");
  EXPECT_EQ(runCarom({"export", file, "-q", "--csv", "-"}).out, trajectory.out);
  for (const Words& words : std::vector<Words>{{"simulate", file, "-o", "-"},
                                               {"simulate", file, "--npy", "-"},
                                               {"compare", "a", "b", "--report", "-"},
                                               {"gallery", file, "-o", "-"}})
    expectUsage(words, " -: this does not go to standard output");
}

}  // namespace
}  // namespace carom::demos
