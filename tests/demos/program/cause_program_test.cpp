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
    std::string text = kScene;
    text.replace(text.find("RESTITUTION"), 11, restitution);
    const fs::path scene = folder_.file("crate.json", text);
    return runCarom({"render", scene.string(), "--portable", "--size", "160x90", "--fps", "4", "-q", "-o",
                     (at(side) / "frame_%04d.png").string()});
  }
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

TEST_F(CauseOfAFault, ThatNoPixelShowsIsNoted) {
  ASSERT_EQ(render("golden", "0.2").code, 0);
  ASSERT_EQ(render("actual", "0.2000001").code, 0);
  const ProgramEnd end =
      runCarom({"compare", at("actual").string(), at("golden").string(), "--progress", "none"});
  EXPECT_EQ(end.code, 0) << end.out;
  EXPECT_NE(end.err.find("passes, but physics moved: restitution of"), std::string::npos) << end.err;
}

}  // namespace
}  // namespace carom::demos
