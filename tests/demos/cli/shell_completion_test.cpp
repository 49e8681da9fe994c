// The completion that is installed, asked by bash itself.
#include "demos/cli/shell_completion.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

class Completion : public testing::Test {
 protected:
  Completion() { folder_.file("carom.bash", runCarom({"--bash-completion"}).out); }

  /// What bash offers for the last of the words, as one line.
  std::string offered(const std::string& words) const {
    const std::string script = folder_
                                   .file("ask.sh", "source '" + (folder_.path() / "carom.bash").string() +
                                                       "'\nCOMP_WORDS=('" CAROM_BINARY "' " + words +
                                                       ")\nCOMP_CWORD=$((${#COMP_WORDS[@]}-1))\n_carom\n"
                                                       "echo \"${COMPREPLY[*]}\"\n")
                                   .string();
    const std::string out = script + ".out";
    EXPECT_EQ(std::system(("bash -eu '" + script + "' > '" + out + "' 2>&1").c_str()), 0);
    const std::string line = readTextFile(out);
    return line.substr(0, line.size() - 1);
  }

  TemporaryFolder folder_;
};

TEST_F(Completion, OffersCommandsThenOptionsThenValuesAndScenes) {
  EXPECT_EQ(offered("ren"), "render");
  EXPECT_EQ(offered("--v"), "--version");
  EXPECT_EQ(offered("budget --ba"), "--baseline");
  EXPECT_EQ(offered("compare a b --tol"), "--tolerance --tolerance16");
  EXPECT_EQ(offered("render sliding --progress ''"), "json none auto");
  EXPECT_EQ(offered("render multi"), "multi-contact");
  EXPECT_EQ(offered("export fifty"), "fifty-bodies");
}

// Where it has nothing to say, bash offers files.
TEST_F(Completion, LeavesFilesToBash) {
  EXPECT_EQ(offered("render sliding -o ''"), "");
  EXPECT_EQ(offered("compare ''"), "");
  EXPECT_EQ(offered("nonsense x"), "");
}

bool hasShell(const char* name) {
  return std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(ZshCompletion, IsReadByZshAndKnowsEveryCommandAndOption) {
  const std::string script = runCarom({"--zsh-completion"}).out;
  for (const char* part : {"#compdef carom", "'render:", "'(-o --output)'{-o,--output}'[", "    budget)",
                           ":value:(json none auto)'", "'1:scene:_carom_scenes'"})
    EXPECT_NE(script.find(part), std::string::npos) << part;
  if (!hasShell("zsh")) GTEST_SKIP() << "zsh is not installed";
  const TemporaryFolder folder;
  EXPECT_EQ(std::system(("zsh -n '" + folder.file("_carom", script).string() + "'").c_str()), 0);
}

TEST(FishCompletion, IsReadByFishAndKnowsEveryCommandAndOption) {
  const std::string script = runCarom({"--fish-completion"}).out;
  for (const char* part :
       {"-a render -d '", "-s o -l output -r -F -d '", "-l progress -x -a 'json none auto'",
        "-n '__fish_seen_subcommand_from export' -a '(carom list"})
    EXPECT_NE(script.find(part), std::string::npos) << part;
  if (!hasShell("fish")) GTEST_SKIP() << "fish is not installed";
  const TemporaryFolder folder;
  EXPECT_EQ(std::system(("fish -n '" + folder.file("carom.fish", script).string() + "'").c_str()), 0);
}

}  // namespace
}  // namespace carom::demos
