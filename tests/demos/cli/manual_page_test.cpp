#include "demos/cli/manual_page.h"

#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {

TEST(ManualPage, WordsThatTroffWouldTakeForItsOwnAreText) {
  ProgramDescription program{"carom", "1.2.3", "It draws.", {}, {}};
  program.commands.push_back({"render",
                              ".starts with a dot\n'and a quote",
                              {{{"SCENE"}, false, {}, "A name"}},
                              {{{"-p", "--progress"}, true, {"json", "none"}, "back\\slash"}},
                              "carom render -p json"});
  const std::string page = manualPage(program);
  EXPECT_EQ(page.rfind(".TH CAROM 1 \"\" \"carom 1.2.3\"", 0), 0u);
  EXPECT_NE(page.find("\n.SS render\n\\&.starts with a dot\n\\&'and a quote\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\n\\fB\\-p, \\-\\-progress json|none\\fR\nback\\eslash\n"), std::string::npos) << page;
  EXPECT_NE(page.find("\n.nf\ncarom render \\-p json\n.fi\n"), std::string::npos) << page;
}

/// The options that a command's --help shows, by their last names.
std::vector<std::string> optionsInHelp(const std::string& command) {
  const std::string help = runCarom({command, "--help"}).out;
  std::vector<std::string> names;
  for (std::size_t at = help.find("\n  -"); at != std::string::npos; at = help.find("\n  -", at + 1)) {
    const std::size_t begin = help.find("--", at), end = help.find_first_of(" \n[", begin);
    names.push_back(help.substr(begin, end - begin));
  }
  return names;
}

TEST(ManualPage, OfTheProgramHoldsEveryOptionOfEveryCommandAndManAcceptsIt) {
  const ProgramEnd end = runCarom({"--manual-page"});
  ASSERT_EQ(end.code, 0) << end.err;
  for (const char* command :
       {"list", "render", "simulate", "export", "check", "distance", "compare", "budget", "doctor"}) {
    const std::size_t begin = end.out.find("\n.SS " + std::string(command) + "\n");
    ASSERT_NE(begin, std::string::npos) << command;
    std::string section = end.out.substr(begin + 1, end.out.find("\n.S", begin + 1) - begin);
    for (std::size_t dash = section.find("\\-"); dash != std::string::npos; dash = section.find("\\-"))
      section.erase(dash, 1);
    const std::vector<std::string> options = optionsInHelp(command);
    EXPECT_FALSE(options.empty());
    for (const std::string& option : options)
      EXPECT_NE(section.find(option), std::string::npos) << command << ' ' << option;
  }
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "no groff to try it with";
  const TemporaryFolder folder;
  const std::string page = folder.file("carom.1", end.out).string();
  const std::string line = "groff -man -Tascii -ww '" + page + "' > '" + page + ".txt' 2> '" + page + ".err'";
  EXPECT_EQ(std::system(line.c_str()), 0);
  EXPECT_EQ(readTextFile(page + ".err"), "");
}

}  // namespace
}  // namespace carom::demos
