// `carom new` and `--set`, from outside.
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

TEST(NewProgram, WritesASceneThatRunsWithoutAWarningAndNeverOverAnother) {
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "mine.json").string();
  EXPECT_EQ(runCarom({"new", scene}).code, 0);
  const ProgramEnd checked = runCarom({"check", scene});
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_EQ(checked.err, "");
  const std::string text = readTextFile(scene);
  EXPECT_EQ(runCarom({"new", scene}).code, 4);
  EXPECT_EQ(readTextFile(scene), text);
  EXPECT_EQ(runCarom({"new", (folder.path() / "mine.txt").string()}).code, 2);
}

TEST(NewProgram, SetChangesTheSceneItsBodiesAndItsHash) {
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "mine.json").string();
  runCarom({"new", scene});
  const std::string plain = runCarom({"check", scene}).out;
  const std::string higher = runCarom({"check", scene, "--set", "set.rows=5", "--set", "duration=1"}).out;
  EXPECT_NE(plain.find("12 bodies"), std::string::npos) << plain;
  EXPECT_NE(higher.find("18 bodies"), std::string::npos) << higher;
  EXPECT_NE(higher.find("  1 s at "), std::string::npos) << higher;
  EXPECT_NE(plain.substr(plain.find("hash")), higher.substr(higher.find("hash")));
  const ProgramEnd wrong = runCarom({"check", scene, "--set", "bodies.bal.position=[0,0,9]"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean \"ball\"?"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace carom::demos
