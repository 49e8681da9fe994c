// `carom compare` from outside: exit codes, what it says where, what it leaves on disk.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;
using renderer::Raster;

/// Two folders: one pair the same, and whatever a test adds.
class Compare : public testing::Test {
 protected:
  Compare() { add("a.png", golden_, golden_); }
  void add(const std::string& name, const Raster& actual, const Raster& golden) const {
    writePng(at("actual/" + name), actual);
    writePng(at("golden/" + name), golden);
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  ProgramEnd run(std::vector<std::string> options = {}) const {
    const std::vector<std::string> paths = {"compare", at("actual").string(), at("golden").string(), "-q"};
    options.insert(options.begin(), paths.begin(), paths.end());
    return runCarom(options);
  }
  Json json(const ProgramEnd& end) const { return Json::parse(end.out, "stdout"); }

  TemporaryFolder folder_;
  Raster golden_ = flatRaster(40, 30, 100);
};

TEST_F(Compare, FoldersThatPassEndWith0AndLeaveNothingBehind) {
  add("b.png", flatRaster(40, 30, 102), golden_);
  const Program program({"compare", at("actual").string(), at("golden").string(), "-q"});
  const ProgramEnd end = program.wait();
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.out, "2 of 2 pass\n");
  EXPECT_EQ(end.err, "");
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

TEST_F(Compare, ADifferenceEndsWith1NamesThePlaceAndTheUpdateCommandAndLeavesAReport) {
  add("b.png", changed(golden_, 33, 7, 62), golden_);
  const Program program({"compare", at("actual").string(), at("golden").string(), "-q", "--tolerance", "5"});
  const ProgramEnd end = program.wait();
  EXPECT_EQ(end.code, 1);
  EXPECT_EQ(
      end.out,
      "b.png  differs  largest 62/255 at (33, 7) in red  1 pixel beyond 5/255  worst tile 8x30 at (32, 0)\n"
      "1 of 2 pass, 1 differs\n");
  expectOneLine(end, "1 of 2 pass, 1 differs; report: compare-report.html; accept with: carom compare " +
                         at("actual").string() + " " + at("golden").string() + " --tolerance 5 --update");
  EXPECT_NE(readTextFile(program.folder() / "compare-report.html").find("<!doctype html>"),
            std::string::npos);
}

TEST_F(Compare, TwoFilesAreComparedToo) {
  const fs::path b = writePng(at("b.png"), changed(golden_, 0, 0, 3));
  EXPECT_EQ(runCarom({"compare", b.string(), at("golden/a.png").string(), "-q"}).code, 1);
  EXPECT_EQ(runCarom({"compare", b.string(), at("golden/a.png").string(), "-q", "--tolerance", "3"}).code, 0);
  EXPECT_EQ(runCarom({"compare", b.string(), at("golden/a.png").string(), "-q", "--allow-pixels", "1"}).code,
            0);
}

TEST_F(Compare, WhatIsNoFileEndsWith3AtOnceAndTheOthersAreComparedAllTheSame) {
  for (const char* side : {"actual/", "golden/"}) {
    fs::create_symlink("self.png", at(std::string(side) + "self.png"));
    ASSERT_EQ(mkfifo(at(std::string(side) + "pipe.png").c_str(), 0600), 0);
  }
  const ProgramEnd end = run();
  EXPECT_EQ(end.code, 3);
  EXPECT_NE(end.out.find("1 of 3 pass, 2 unreadable"), std::string::npos) << end.out;
  expectOneLine(end, "it is a pipe");
  for (const char* name : {"actual/self.png", "actual/pipe.png"}) {
    const ProgramEnd alone = runCarom({"compare", at(name).string(), at(name).string(), "-q", "--report",
                                       "none", "--differences", at("differences").string()});
    EXPECT_EQ(alone.code, 3);
    expectOneLine(alone, at(name).string());
  }
}

// Names of files and texts of frames come from elsewhere: none of them begins a line or changes a colour.
TEST_F(Compare, NamesAndTextsWithLineBreaksStayInOneLine) {
  const std::string name = "b\n\x1b[31m.png";
  writePng(at("actual/" + name), changed(golden_, 0, 0, 9), {{"Camera", "two\nlines"}});
  writePng(at("golden/" + name), golden_, {{"Camera", "one"}});
  const ProgramEnd end = run({"--report", "none"});
  EXPECT_EQ(end.code, 1);
  EXPECT_EQ(std::count(end.out.begin(), end.out.end(), '\n'), 2) << end.out;
  EXPECT_NE(end.out.find("b\\n\\x1b[31m.png  differs"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("one became two\\nlines"), std::string::npos) << end.out;
  fs::remove(at("actual/" + name));
  const ProgramEnd updated = run({"--report", "none", "--update"});
  EXPECT_EQ(updated.code, 1);
  expectOneLine(updated, "has no counterpart and stays");
}

TEST_F(Compare, MissingExtraAndOtherSizesEndWith1) {
  const std::map<std::string, std::string> found = {
      {"b.png", "missing  no " + at("actual/b.png").string()},
      {"c.png", "extra  no " + at("golden/c.png").string()},
      {"d.png", "size differs  30x40 8-bit RGB, golden 40x30 8-bit RGB"}};
  add("d.png", flatRaster(30, 40, 100), golden_);
  writePng(at("golden/b.png"), golden_);
  writePng(at("actual/c.png"), golden_);
  const ProgramEnd end = run({"--tolerance", "255", "--allow-pixels", "9999"});
  EXPECT_EQ(end.code, 1);
  for (const auto& [name, line] : found)
    EXPECT_NE(end.out.find(name + "  " + line + "\n"), std::string::npos) << end.out;
}

TEST_F(Compare, ATruncatedFileEndsWith3ButTheOthersAreStillCompared) {
  add("b.png", golden_, golden_);
  add("c.png", flatRaster(40, 30, 200), golden_);
  truncateFile(at("actual/b.png"));
  const ProgramEnd end = run({"--json"});
  EXPECT_EQ(end.code, 3);
  expectOneLine(end, "cannot decode PNG '" + at("actual/b.png").string() + "': the file is truncated");
  EXPECT_EQ(json(end).at("counts").at("unreadable").asNumber(), 1.0);
  EXPECT_EQ(json(end).at("counts").at("differ").asNumber(), 1.0);
  EXPECT_EQ(run({"--update"}).code, 3);  // what is whole is accepted, what is broken is still said
  EXPECT_EQ(readTextFile(at("golden/c.png")), readTextFile(at("actual/c.png")));
}

TEST_F(Compare, WhatCannotBeComparedEndsWith2Or3InOneLine) {
  const std::string file = at("actual/a.png").string(), folder = at("golden").string();
  const std::map<std::string, std::pair<int, std::vector<std::string>>> cases = {
      {"GOLDEN", {2, {"compare", file}}},
      {"are a file and a folder", {2, {"compare", file, folder}}},
      {"--tolerance", {2, {"compare", file, file, "--tolerance", "256"}}},
      {"--allow-pixels", {2, {"compare", file, file, "--allow-pixels", "-1"}}},
      {"unknown option --tolerence; did you mean \"--tolerance\"?",
       {2, {"compare", file, file, "--tolerence", "1"}}},
      {"lies in", {2, {"compare", folder, folder, "--differences", folder + "/d"}}},
      {"no such file or folder", {3, {"compare", folder, folder + "/none"}}},
      {"is no PNG file", {3, {"compare", folder_.file("x.png", "hello, not a PNG").string(), file}}}};
  for (const auto& [part, expected] : cases) {
    const ProgramEnd end = runCarom(expected.second);
    EXPECT_EQ(end.code, expected.first) << part;
    std::string last = end.err.substr(end.err.rfind('\n', end.err.size() - 2) + 1);  // after progress
    expectOneLine({end.code, end.out, last}, part);
  }
}

TEST_F(Compare, UnwritableTargetsEndWith4) {
  add("b.png", flatRaster(40, 30, 200), golden_);
  const std::string below_a_file = (folder_.file("file", "") / "x").string();
  for (const char* option : {"--report", "--junit", "--differences"}) {
    const ProgramEnd end = run({option, below_a_file});
    EXPECT_EQ(end.code, 4) << option;
    expectOneLine(end, "cannot write " + below_a_file);
  }
  EXPECT_EQ(runCarom({"compare", at("actual/b.png").string(), below_a_file, "-q", "--update"}).code, 4);
}

TEST_F(Compare, TheVerdictIsToldWhateverCannotBeWritten) {
  add("b.png", changed(golden_, 33, 7, 62), golden_);
  // A folder that is in the place of the usual report cannot be replaced by it, not even by root.
  const std::vector<std::string> words = {"compare", at("actual").string(), at("golden").string()};
  const Program usual(words);
  fs::create_directories(usual.folder() / "compare-report.html");
  const ProgramEnd end = usual.wait();
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.out.find("1 of 2 pass, 1 differs"), std::string::npos) << end.out;
  EXPECT_NE(end.err.find("note: cannot write compare-report.html: "), std::string::npos) << end.err;
  EXPECT_EQ(end.err.find("; report: "), std::string::npos) << end.err;
  for (const char* option : {"--report", "--junit"}) {
    const ProgramEnd asked = run({option, folder_.path().string()});
    expectOneLine(asked, 4, "cannot write");
    EXPECT_NE(asked.out.find("1 of 2 pass, 1 differs"), std::string::npos) << asked.out;
  }
  // Golden files are replaced last: not where what was to be shown of them was not.
  EXPECT_EQ(run({"--update", "--report", folder_.path().string()}).code, 4);
  EXPECT_EQ(run({"--report", "none"}).code, 1);
}

TEST_F(Compare, JsonTellsEveryPairInTheOrderOfNames) {
  add("z.png", golden_, golden_);
  add("b.png", changed(golden_, 33, 7, 62), golden_);
  const ProgramEnd end = run({"--json", "--report", "none"});
  EXPECT_EQ(end.code, 1);
  const Json all = json(end);
  EXPECT_FALSE(all.at("passes").asBoolean());
  EXPECT_EQ(all.find("report"), nullptr);
  const std::vector<Json>& pairs = all.at("pairs").items();
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].at("name").asString() + pairs[1].at("name").asString() + pairs[2].at("name").asString(),
            "a.pngb.pngz.png");
  const Json& difference = pairs[1].at("difference");
  EXPECT_EQ(difference.at("largest").asNumber(), 62.0);
  EXPECT_EQ(difference.at("largestAt").items()[0].asNumber(), 33.0);
  EXPECT_EQ(difference.at("pixelsBeyond").asNumber(), 1.0);
  EXPECT_EQ(difference.at("worstTile").at("x").asNumber(), 32.0);
  EXPECT_EQ(run({"--json", "--report", "none"}).out, end.out);  // the same each time
}

TEST_F(Compare, JunitAndDifferenceImagesAreWrittenWhereAskedFor) {
  add("sub/b.png", changed(golden_, 33, 7, 4), golden_);
  EXPECT_EQ(run({"--junit", at("j.xml").string(), "--differences", at("d").string(), "--amplify", "10"}).code,
            1);
  EXPECT_NE(readTextFile(at("j.xml")).find("name=\"sub/b.png\">\n      <failure type=\"differs\""),
            std::string::npos);
  const Raster difference = renderer::readPngRaster(at("d/sub/b.png")).raster;
  EXPECT_EQ(*difference.pixel(33, 7), 85);  // 4 * 10, raised to what can be seen
  EXPECT_EQ(*difference.pixel(32, 7), 0);
  EXPECT_EQ(std::distance(fs::recursive_directory_iterator(at("d")), fs::recursive_directory_iterator()), 2);
}

TEST_F(Compare, UpdateShowsWhatItReplacesAndMakesTheNextRunPass) {
  add("b.png", flatRaster(40, 30, 200), golden_);
  writePng(at("actual/new/c.png"), golden_);
  const std::string report = at("report.html").string();
  const ProgramEnd end = run({"--update", "--report", report});
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_NE(end.out.find("replaced  b.png  differs  largest 100/255"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("added  new/c.png  extra"), std::string::npos) << end.out;
  EXPECT_NE(readTextFile(report).find("\"update\":\"replaced\""), std::string::npos);
  EXPECT_EQ(run().code, 0);
  EXPECT_EQ(readTextFile(at("golden/b.png")), readTextFile(at("actual/b.png")));
}

TEST_F(Compare, UpdateMakesGoldenFilesWhereThereAreNone) {
  const std::string fresh = at("fresh").string();
  EXPECT_EQ(runCarom({"compare", at("actual").string(), fresh, "-q"}).code, 3);
  EXPECT_EQ(runCarom({"compare", at("actual").string(), fresh, "-q", "--update"}).code, 0);
  EXPECT_EQ(runCarom({"compare", at("actual").string(), fresh, "-q"}).code, 0);
}

TEST_F(Compare, UpdateNeverDeletesAGoldenFile) {
  writePng(at("golden/gone.png"), golden_);
  const ProgramEnd end = run({"--update"});
  EXPECT_EQ(end.code, 1);
  expectOneLine(end, "1 golden file has no counterpart and stays: " + at("golden/gone.png").string());
  EXPECT_TRUE(fs::exists(at("golden/gone.png")));
}

TEST_F(Compare, DepthAndIdsAreGatedWithAllTheirBits) {
  const Raster ids = flatRaster(40, 30, 7, 1, 16);
  add("id.png", changed(ids, 3, 4, 1), ids);
  const ProgramEnd end = run();
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.out.find("id.png  differs  largest 1/65535 at (3, 4) in grey"), std::string::npos) << end.out;
  EXPECT_EQ(run({"--tolerance16", "1"}).code, 0);
}

TEST_F(Compare, SixteenBitColoursAndGreysAreComparedToTheLastBitAndNeverWithEightBits) {
  const Raster grey = flatRaster(40, 30, 40000, 1, 16), colour = flatRaster(40, 30, 40000, 3, 16);
  add("colour.png", changed(colour, 5, 6, -7), colour);
  add("grey.png", grey, grey);
  add("same.png", grey, colour);
  add("bits.png", flatRaster(40, 30, 156, 1, 8), grey);
  const ProgramEnd end = run({"--tolerance", "255", "--differences", at("d").string()});
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.out.find("colour.png  differs  largest 7/65535 at (5, 6) in red  1 pixel beyond 0/65535"),
            std::string::npos)
      << end.out;
  EXPECT_NE(end.out.find("bits.png  size differs  40x30 8-bit grey, golden 40x30 16-bit grey"),
            std::string::npos)
      << end.out;
  EXPECT_NE(end.out.find("3 of 5 pass"), std::string::npos) << end.out;
  EXPECT_EQ(run({"--tolerance16", "7"}).out.find("colour.png"), std::string::npos);
}

TEST_F(Compare, AnInterruptLeavesNoHalfWrittenReport) {
  add("0.png", flatRaster(1600, 1200, 9), flatRaster(1600, 1200, 99));
  for (const char* folder : {"actual/", "golden/"})
    for (int i = 1; i < 200; ++i)
      fs::create_hard_link(at(folder + std::string("0.png")), at(folder + std::to_string(i) + ".png"));
  const Program program({"compare", at("actual").string(), at("golden").string(), "-q"});
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait().code, 143);
  EXPECT_TRUE(fs::is_empty(program.folder()));
}

}  // namespace
}  // namespace carom::demos
