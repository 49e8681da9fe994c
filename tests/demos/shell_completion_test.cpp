// The completion that is installed, asked by bash itself.
#include "demos/shell_completion.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "program_run.h"

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

}  // namespace
}  // namespace carom::demos
