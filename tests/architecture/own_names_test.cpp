// Files of one folder of the engine call nothing of their own alike: a reader who looks for a name finds one,
// and a build may compile the folder as one file, as tests/checks.sh does.

#include "tests/architecture/own_names.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/architecture/source_tree.h"

namespace carom::architecture {
namespace {

using Names = std::set<std::string>;

TEST(OwnNames, AreOneFilesAloneInItsFolder) {
  std::map<std::pair<std::string, std::string>, std::string> files;
  for (const auto& [path, text] : sourcesOfTheTree({"engine"})) {
    if (!path.ends_with(".cpp")) continue;
    const std::string folder = path.substr(0, path.rfind('/'));
    for (const std::string& name : ownNames(text)) {
      const auto [known, is_new] = files.emplace(std::pair(folder, name), path);
      EXPECT_TRUE(is_new) << path << " and " << known->second << " both have a " << name << " of their own";
    }
  }
  EXPECT_GT(files.size(), 400u);
}

// The reader of the names itself.

TEST(OwnNamesOfAText, AreThoseOfUnnamedNamespacesAlone) {
  EXPECT_EQ(ownNames("namespace carom {\nint outside();\nnamespace {\nint f(int a);\nint g() { int h = 1; "
                     "return h; }\n}\n"
                     "int also() { return 2; }\n}"),
            (Names{"f", "g"}));
  EXPECT_EQ(ownNames("namespace {\nnamespace inner {\nint f();\n}\n}"), Names{"f"});
}

TEST(OwnNamesOfAText, AreConstantsTypesAliasesTemplatesAndLambdas) {
  EXPECT_EQ(
      ownNames(
          "namespace {\nconstexpr int kA = int{32} << 10, kB = 1;\nconst Vec3 kC{1, 2, 3};\nint table[3][2] "
          "= "
          "{{1}};\n"
          "struct D { int inside = 1; void f(); };\nenum class E : char { kX };\nusing F = "
          "std::vector<int>;\n"
          "using oracle::Random;\ntemplate <class T>\nT g(T t) { return t; }\n"
          "const auto h = [](int x) { int y = x; return y; };\nclass I final : public J {\n int i_;\n};\n}"),
      (Names{"kA", "kC", "table", "D", "E", "F", "g", "h", "I"}));
}

TEST(OwnNamesOfAText, LetOperatorsCommentsAndDirectivesThrough) {
  EXPECT_TRUE(
      ownNames("namespace {\n// int f();\n#define X int g() {\nbool operator==(A a, A b) { return true; }\n"
               "static_assert(sizeof(int) == 4);\nusing namespace std;\n}")
          .empty());
}

}  // namespace
}  // namespace carom::architecture
