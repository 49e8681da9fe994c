// `carom regress`, variants, masks, acceptance and undo from outside.
#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "tests/demos/support/png_files.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr char kScene[] = R"({ "format": 1, "duration": 0.2, "bodies": [
  { "name": "ball", "shape": { "sphere": { "radius": 0.5 } }, "position": [0, 0, HEIGHT] } ],
  "cameras": { "main": { "eye": [6, -9, 5], "target": [0, 0, 1] } } })";

class Suite : public testing::Test {
 protected:
  Suite() {
    writeScene("2");
    file("suite.json", R"({ "format": 1, "render": ["--portable", "--size", "64x48", "--fps", "10"],
      "scenes": [ { "name": "ball", "scene": "ball.json" }, { "name": "slow", "scene": "ball.json", "render": ["--speed", "0.5"] } ] })");
  }
  void writeScene(const std::string& height) {
    std::string text = kScene;
    text.replace(text.find("HEIGHT"), 6, height);
    file("ball.json", text);
  }
  void file(const std::string& name, const std::string& text) { folder_.file(name, text); }
  ProgramEnd run(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"regress", folder_.path().string(), "-q", "-o", at("out").string()};
    words.insert(words.end(), more.begin(), more.end());
    return runCarom(words);
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

TEST_F(Suite, IsAcceptedPassesAndNamesTheSceneAndTheCauseThatFails) {
  EXPECT_EQ(run().code, 3);  // there are no golden frames yet
  EXPECT_EQ(run({"--update"}).code, 0);
  EXPECT_TRUE(fs::exists(at("slow/states.carom")));
  const ProgramEnd good = run({"--junit", at("j.xml").string()});
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  EXPECT_EQ(good.out.rfind("2 of 2 scenes pass; index: ", 0), 0u) << good.out;
  writeScene("2.2");
  const ProgramEnd bad = run({"--json", "--junit", at("j.xml").string(), "--jobs", "2"});
  EXPECT_EQ(bad.code, 1) << bad.err;
  const Json json = Json::parse(bad.out, "stdout");
  EXPECT_EQ(json.at("summary").asString(), "0 of 2 scenes pass, 2 differ");
  EXPECT_NE(json.at("scenes").items()[0].at("cause").asString().find("ball starts 0.2 m away"),
            std::string::npos);
  const std::string page = readTextFile(at("out/index.html")), junit = readTextFile(at("j.xml"));
  EXPECT_NE(page.find("ball/report.html"), std::string::npos);
  EXPECT_NE(page.find("ball starts 0.2 m away"), std::string::npos);
  EXPECT_NE(junit.find("ball starts 0.2 m away"), std::string::npos);
  EXPECT_TRUE(fs::exists(at("out/ball/report.html")));
}

TEST_F(Suite, ReplacesWhatItDrewBefore_AndLeavesWhatOthersPutThere) {
  EXPECT_EQ(run({"--update"}).code, 0);
  file("out/ball/notes.txt", "mine");
  file("out/ball/frames/frame_0099.png", "of a longer run");
  EXPECT_EQ(run().code, 0);
  EXPECT_EQ(readTextFile(at("out/ball/notes.txt")), "mine");
  EXPECT_FALSE(fs::exists(at("out/ball/frames/frame_0099.png")));
}

TEST_F(Suite, ThatIsWrongIsRefusedWithItsPlace) {
  for (const auto& [text, part] :
       std::map<std::string, std::string>{{"{ \"scenes\": [] }", "is empty"},
                                          {"{ \"scenes\": [\"../x\"] }", "accepted: letters"},
                                          {"{ \"scenes\": [\"a\", \"a\"] }", "a second time"},
                                          {"{ \"sceens\": [] }", "sceens"}}) {
    file("suite.json", text);
    const ProgramEnd end = run();
    EXPECT_EQ(end.code, 3) << text;
    EXPECT_NE(end.err.find(part), std::string::npos) << end.err;
  }
}

/// Two pairs that differ.
class Gate : public testing::Test {
 protected:
  Gate() {
    for (const char* name : {"a.png", "b.png"}) {
      writePng(at("actual") / name, changed(golden_, 3, 4, 50));
      writePng(at("golden") / name, golden_);
    }
  }
  ProgramEnd compare(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"compare",  at("actual").string(), at("golden").string(), "-q",
                                      "--report", at("r.html").string()};
    words.insert(words.end(), more.begin(), more.end());
    return runCarom(words);
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  renderer::Raster golden_ = flatRaster(20, 10, 100);
  TemporaryFolder folder_;
};

TEST_F(Gate, AcceptsChosenPairsAndTakesThatBack) {
  EXPECT_EQ(compare({"--accept", "a.png"}).code, 0);
  EXPECT_EQ(readTextFile(at("golden/a.png")), readTextFile(at("actual/a.png")));
  EXPECT_NE(readTextFile(at("golden/b.png")), readTextFile(at("actual/b.png")));
  const ProgramEnd unknown = compare({"--accept", "aa.png"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("did you mean \"a.png\""), std::string::npos) << unknown.err;
  const ProgramEnd undone = compare({"--undo"});
  EXPECT_EQ(undone.code, 0) << undone.err;
  EXPECT_NE(undone.out.find("1 file of "), std::string::npos);
  EXPECT_NE(compare({}).out.find("0 of 2 pass, 2 differ"), std::string::npos);
  EXPECT_EQ(compare({"--undo"}).code, 3);
}

TEST_F(Gate, TakesTheNearestOfSeveralAcceptedImages) {
  writePng(at("golden/a.variants/other.png"), flatRaster(20, 10, 200));
  writePng(at("golden/a.variants/wanted.png"), changed(golden_, 3, 4, 50));
  writePng(at("golden/b.variants/near.png"), changed(golden_, 3, 4, 40));
  const ProgramEnd end = compare({});
  EXPECT_NE(end.out.find("1 of 2 pass, 1 differs"), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("b.png  differs  largest 10/255"), std::string::npos) << end.out;
  EXPECT_NE(readTextFile(at("r.html")).find("near.png"), std::string::npos);
}

// It might have been the one that passes.
TEST_F(Gate, AnAcceptedImageThatIsDamagedIsNoDifference) {
  std::filesystem::create_directories(at("golden/a.variants"));
  std::ofstream(at("golden/a.variants/broken.png")) << "no PNG";
  const ProgramEnd end = compare({});
  EXPECT_EQ(end.code, 3) << end.out;
  EXPECT_NE(end.out.find("broken.png"), std::string::npos) << end.out;
}

TEST_F(Gate, MasksWhatIsNotLookedAt) {
  EXPECT_EQ(compare({"--mask", "rect:3,4,1,1"}).code, 0);
  EXPECT_EQ(compare({"--mask", "rect:4,4,1,1"}).code, 1);
  EXPECT_EQ(compare({"--mask", "circle:4"}).code, 2);
  EXPECT_EQ(compare({"--mask", "body:crate"}).code, 3);
}

}  // namespace
}  // namespace carom::demos
