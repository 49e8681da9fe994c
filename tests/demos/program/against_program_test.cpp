// `carom budget --against` from outside: equal programs, other states, programs that are none.
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "demos/against/paced_program.h"
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

/// What the lines of `script` print in each process of the other program, in the order of the rounds.
std::vector<std::string> toldByOther(const std::string& script, const std::vector<std::string>& more) {
  const TemporaryFolder folder;
  const std::string told = (folder.path() / "told").string();
  const std::filesystem::path other = folder.file(
      "carom", "#!/bin/sh\n{ " + script + "; } >> '" + told + "'\nexec '" CAROM_BINARY "' \"$@\"\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  std::vector<std::string> words = {"budget",     "bouncing-ball", "-q",        "--size",      "16x16",
                                    "--duration", "0.05",          "--against", other.string()};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramEnd end = runCarom(words);
  EXPECT_TRUE(end.code == 0 || end.code == 7) << end.out << end.err;
  std::vector<std::string> lines;
  std::ifstream in(told);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(BudgetAgainst, CpuTimeIsThatOfOneProcessorAfterAnotherAndWallTimeOfAll) {
  const std::vector<int> all = usableProcessors();
  ASSERT_FALSE(all.empty());
  const std::string script = "sed -n 's/Cpus_allowed_list:[[:space:]]*//p' /proc/self/status";
  std::vector<std::string> expected;
  for (int round = 0; round < 5; ++round)
    expected.push_back(std::to_string(all[static_cast<std::size_t>(round / 2) % all.size()]));
  EXPECT_EQ(toldByOther(script, {"--replays", "5", "--clock", "cpu"}), expected);
  const std::string here = endOfShell(script + " | tr -d '\\n'").out;
  EXPECT_EQ(toldByOther(script, {"--replays", "2", "--clock", "wall"}), std::vector<std::string>(2, here));
}

// Two programs that are started with other words would else differ by where their data come to lie.
TEST(BudgetAgainst, MemoryIsLaidOutAnewInEachRound) {
  const std::vector<std::string> counts =
      toldByOther("env | grep -c ^CAROM_PACED_ || true", {"--replays", "21"});
  EXPECT_EQ(counts.size(), 21u);
  EXPECT_GT(std::set<std::string>(counts.begin(), counts.end()).size(), 3u);
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
