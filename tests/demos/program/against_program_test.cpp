// `carom budget --against` from outside: equal programs, other states, programs that are none.
#include <gtest/gtest.h>

#include "demos/format/json.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

std::vector<std::string> against(const std::string& other, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"budget", "bouncing-ball", "-q", "--size",    "64x48", "--duration",
                                    "0.5",    "--replays",     "3",  "--against", other};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(BudgetAgainst, ItselfIsNeverSlowerAndStatesAreEqual) {
  for (const char* clock : {"wall", "cpu"}) {
    const ProgramEnd end = runCarom(against(CAROM_BINARY, {"--clock", clock, "--json", "-"}));
    EXPECT_TRUE(end.code == 0 || end.code == 7) << end.out << end.err;
    const Json json = Json::parse(end.out, "stdout");
    EXPECT_TRUE(json.at("statesEqual").asBoolean());
    EXPECT_EQ(json.at("frames").asNumber(), 30.0);
    EXPECT_EQ(json.at("frame").at("verdict").asString(), "same");
    EXPECT_TRUE(json.at("otherWork").items().empty());
  }
}

TEST(BudgetAgainst, TheSameProgramWithADearerPresetIsFasterAndNamesDrawing) {
  const ProgramEnd end = runCarom({"budget", "bouncing-ball", "-q", "--size", "64x48", "--duration", "0.2",
                                   "--against", std::string(CAROM_BINARY) + " --preset cinematic"});
  EXPECT_NE(end.out.find("faster: draw by "), std::string::npos) << end.out << end.err;
  EXPECT_NE(end.out.find("faster: frame by "), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("other work: "), std::string::npos) << end.out;
}

TEST(BudgetAgainst, OtherStatesAreSaidWithTheirFrame) {
  const TemporaryFolder folder;
  const std::string scene = R"({ "format": 1, "duration": 0.5, "bodies": [
    { "name": "ball", "shape": { "sphere": { "radius": 0.5 } }, "position": [0, 0, 3] } ],
    "cameras": { "main": { "eye": [6, -9, 5], "target": [0, 0, 1] } } })";
  const std::string file = folder.file("a.json", scene).string();
  const std::string other = std::string(CAROM_BINARY) + " --duration 0.25";
  ProgramEnd end = runCarom({"budget", file, "-q", "--size", "64x48", "--replays", "2", "--against", other});
  EXPECT_NE(end.err.find("has 15 frames, not 30"), std::string::npos) << end.err << end.out;
  EXPECT_EQ(end.code, 3);
}

TEST(BudgetAgainst, WhatIsNoCaromEndsWithOneLine) {
  for (const char* other : {"/bin/true", "/nowhere/carom", "/bin/echo hello"}) {
    const ProgramEnd end = runCarom(against(other));
    EXPECT_EQ(end.code, 3) << other;
    EXPECT_EQ(std::count(end.err.begin(), end.err.end(), '\n'), 1) << end.err;
    EXPECT_NE(end.err.find("--against: "), std::string::npos) << end.err;
  }
  EXPECT_EQ(runCarom(against("x", {"--csv", "-"})).code, 2);
}

}  // namespace
}  // namespace carom::demos
