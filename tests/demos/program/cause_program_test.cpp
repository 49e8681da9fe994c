// A fault in a scene, seen through the program: rendered, compared, named in every form of the answer.
#include <gtest/gtest.h>

#include "demos/cause/motion_record.h"
#include "demos/format/json.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

constexpr char kScene[] = R"({ "format": 1, "rate": 240, "duration": 1,
  "materials": { "wood": { "restitution": RESTITUTION, "color": "#b5793d" } },
  "bodies": [
    { "name": "floor", "shape": { "box": [20, 20, 1] }, "position": [0, 0, -0.5], "static": true, "material": "wood" },
    { "name": "crate", "shape": { "box": [1, 1, 1] }, "position": [0, 0, 1], "material": "wood" } ],
  "cameras": { "main": { "eye": [6, -9, 5], "target": [0, 0, 1] } } })";

class CauseOfAFault : public testing::Test {
 protected:
  ProgramEnd render(const std::string& side, const std::string& restitution) {
    return draw(side, restitution, {"--portable"});
  }
  ProgramEnd draw(const std::string& side, const std::string& restitution,
                  const std::vector<std::string>& options) {
    std::string text = kScene;
    text.replace(text.find("RESTITUTION"), 11, restitution);
    const fs::path scene = folder_.file("crate.json", text);
    std::vector<std::string> words = {
        "render", scene.string(), "--size", "160x90", "--fps",
        "4",      "--progress",   "none",   "-o",     (at(side) / "frame_%04d.png").string()};
    words.insert(words.end(), options.begin(), options.end());
    return runCarom(words);
  }
  std::string recordOf(const std::string& side) const { return readTextFile(at(side) / kRecordName); }
  ProgramEnd compare(std::vector<std::string> options) {
    options.insert(options.begin(), {"compare", at("actual").string(), at("golden").string(), "-q"});
    return runCarom(options);
  }
  fs::path at(const std::string& name) const { return folder_.path() / name; }
  TemporaryFolder folder_;
};

TEST_F(CauseOfAFault, IsNamedInTextJsonJunitAndReport) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(render("actual", "0.7").code, 0);
  const std::string cause = "restitution of floor, crate is 0.7, was 0.2";
  const ProgramEnd text = compare({"--report", at("r.html").string(), "--junit", at("r.xml").string()});
  EXPECT_EQ(text.code, 1);
  EXPECT_NE(text.out.find(cause), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("first event that differs: at "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("moved: crate by "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("the difference lies on crate and its shadow"), std::string::npos) << text.out;
  EXPECT_NE(readTextFile(at("r.html")).find(cause), std::string::npos);
  EXPECT_NE(readTextFile(at("r.xml")).find(cause), std::string::npos);
  const Json json = Json::parse(compare({"--json", "--report", "none"}).out, "stdout");
  for (const Json& pair : json.at("pairs").items()) {
    if (pair.find("causes") == nullptr) continue;
    EXPECT_EQ(pair.at("causes").at("changes").items()[0].at("part").asString(), "material");
    EXPECT_GT(pair.at("causes").at("since_s").asNumber(), 0.0);
  }
}

TEST_F(CauseOfAFault, TheRecordFitsAndIsTheSameOnEveryRunAndIsAcceptedWithTheFrames) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(render("actual", "0.2").code, 0);
  const std::string record = readTextFile(at("golden") / kRecordName);
  EXPECT_LE(record.size(), kMostRecordBytes);
  EXPECT_EQ(record, readTextFile(at("actual") / kRecordName));
  EXPECT_EQ(compare({}).code, 0);
  ASSERT_EQ(render("actual", "0.7").code, 0);
  EXPECT_EQ(compare({"--update"}).code, 0);
  EXPECT_EQ(readTextFile(at("golden") / kRecordName), readTextFile(at("actual") / kRecordName));
}

// Worker processes have no record to put pixels into: the first version ended by a signal.
TEST_F(CauseOfAFault, ARecordedRunOfManyFramesIsTheSameForAnyNumberOfWorkers) {
  const fs::path scene = folder_.file(
      "crate.json", std::string(kScene).replace(std::string(kScene).find("RESTITUTION"), 11, "0.2"));
  for (const char* workers : {"1", "3"}) {
    const ProgramEnd end =
        runCarom({"render", scene.string(), "--states", "--size", "64x36", "--fps", "30", "-q", "--workers",
                  workers, "-o", (at(workers) / "frame_%04d.png").string()});
    ASSERT_EQ(end.code, 0) << end.err;
  }
  EXPECT_EQ(readTextFile(at("1") / kRecordName), readTextFile(at("3") / kRecordName));
}

// The records that an earlier run left masked and named what was no longer there, and were accepted.
TEST_F(CauseOfAFault, TheRecordOfAnEarlierRunIsNotThatOfTheFrames) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(draw("actual", "0.2", {"--portable", "--set", "cameras.main.target=[2,0,1]"}).code, 0);
  ASSERT_EQ(draw("actual", "0.2", {"--set", "materials.wood.color=#4477aa"}).code, 0);
  ASSERT_TRUE(fs::exists(at("actual") / kRecordName)) << "it may be of other frames";
  const std::string with_it = compare({"--mask", "body:crate", "--report", "none"}).out;
  EXPECT_EQ(compare({"--update", "--report", "none"}).code, 0);
  EXPECT_FALSE(recordOf("golden") == recordOf("actual"));
  EXPECT_EQ(compare({"--undo"}).code, 0);
  fs::remove(at("actual") / kRecordName);
  EXPECT_EQ(compare({"--mask", "body:crate", "--report", "none"}).out, with_it);
}

// Kept frames had no pixels in the new record, so that bodies could not be masked any more.
TEST_F(CauseOfAFault, AResumedRunHasTheRecordOfAWholeOne) {
  ASSERT_EQ(render("whole", "0.2").code, 0);
  const std::string record = recordOf("whole");
  for (const char* missing : {"none", "states.carom", "frame_0002.png"}) {
    fs::remove(at("whole") / missing);
    ASSERT_EQ(draw("whole", "0.2", {"--portable", "--resume"}).code, 0);
    EXPECT_TRUE(recordOf("whole") == record) << missing;
  }
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(draw("parts", "0.2", {"--portable", "--resume", "--shard", shard}).code, 0);
  EXPECT_FALSE(fs::exists(at("parts") / kRecordName));
  ASSERT_EQ(draw("parts", "0.2", {"--portable", "--resume"}).code, 0);
  EXPECT_TRUE(recordOf("parts") == record);
}

TEST_F(CauseOfAFault, FramesDrawnAnewLeaveTheRecordOfAll) {
  ASSERT_EQ(render("whole", "0.2").code, 0);
  const std::string record = recordOf("whole");
  const ProgramEnd told = draw("whole", "0.2", {"--portable", "--frames", "2"});
  ASSERT_EQ(told.code, 0);
  EXPECT_TRUE(recordOf("whole") == record);
  EXPECT_NE(told.err.find("states.carom is of other frames, too, and stays as it is"), std::string::npos)
      << told.err;
  // Where there are no others, they have a record of their own.
  for (const char* restitution : {"0.2", "0.7"})
    ASSERT_EQ(draw("few", restitution, {"--portable", "--frames", "1,3"}).code, 0);
  const MotionRecord few = readRecord(at("few") / kRecordName);
  ASSERT_EQ(few.shots.size(), 2u);
  EXPECT_EQ(few.bodies[1].stuff[2].second, "0.7");
}

TEST_F(CauseOfAFault, ThatNoRecordKnowsIsAnEditOfTheScene) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  const char* edits[] = {"bodies.crate.force=[9000,0,0]", "bodies.crate.locked=[\"z\"]"};
  for (const char* edit : edits) {
    ASSERT_EQ(draw("actual", "0.2", {"--portable", "--set", edit}).code, 0) << edit;
    const std::string told = compare({"--report", "none"}).out;
    EXPECT_NE(told.find("physics moved: the scene was edited, other states from step 1 "), std::string::npos)
        << edit << '\n'
        << told;
    EXPECT_EQ(told.find("the same scene"), std::string::npos) << told;
  }
  ASSERT_EQ(
      draw("actual", "0.2", {"--portable", "--set", R"(bodies.crate.visual={"file":"meshes/gem.obj"})"}).code,
      0);
  const std::string told = compare({"--report", "none"}).out;
  EXPECT_NE(told.find("the same motion, another look: the scene was edited"), std::string::npos) << told;
  EXPECT_EQ(told.find("the renderer changed"), std::string::npos) << told;
}

TEST_F(CauseOfAFault, ThatNoPixelShowsIsNoted) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(render("actual", "0.2000001").code, 0);
  const ProgramEnd end =
      runCarom({"compare", at("actual").string(), at("golden").string(), "--progress", "none"});
  EXPECT_EQ(end.code, 0) << end.out;
  EXPECT_NE(end.err.find("passes, but physics moved: restitution of"), std::string::npos) << end.err;
}

// They kept their old state beside a record of the new one, which then told nothing of them.
TEST_F(CauseOfAFault, FramesThatPassAreAcceptedWithARecordOfOtherStates) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(render("actual", "0.2000001").code, 0);
  const std::string golden = readTextFile(at("golden/frame_0003.png"));
  EXPECT_EQ(compare({"--update"}).code, 0);
  EXPECT_TRUE(recordOf("golden") == recordOf("actual"));
  EXPECT_TRUE(readTextFile(at("golden/frame_0003.png")) == readTextFile(at("actual/frame_0003.png")));
  EXPECT_EQ(compare({"--undo"}).code, 0);
  EXPECT_TRUE(readTextFile(at("golden/frame_0003.png")) == golden);
  EXPECT_EQ(compare({"--update"}).code, 0);
  ASSERT_EQ(render("actual", "0.7").code, 0);
  const std::string told = compare({"--report", "none"}).out;
  EXPECT_NE(told.find("restitution of floor, crate is 0.7, was 0.2"), std::string::npos) << told;
}

}  // namespace
}  // namespace carom::demos
