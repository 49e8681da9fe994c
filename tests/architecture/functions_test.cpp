// No function takes more than six parameters, and none keeps memory of its thread: what a call needs it is
// given, has in its own frame, or borrows.

#include <gtest/gtest.h>

#include "tests/architecture/function_rules.h"
#include "tests/architecture/source_tree.h"

namespace carom::architecture {
namespace {

TEST(Functions, TakeNoMoreThanSixParameters) {
  for (const auto& [path, text] : sourcesOfTheTree({"engine", "renderer", "demos", "tests"}))
    for (const LongList& list : longParameterLists(text))
      ADD_FAILURE() << path << ":" << list.line << ": " << list.function << " takes " << list.parameters
                    << " parameters; a struct with designated initialisers names them";
}

TEST(Functions, KeepNoMemoryOfTheirThread) {
  for (const auto& [path, text] : sourcesOfTheTree())
    for (const int line : threadLocalLines(text))
      ADD_FAILURE()
          << path << ":" << line
          << ": thread_local; lists of one call go in a StackArena, or are borrowed of an ObjectPool";
}

// The reader of the lists itself.

std::vector<std::size_t> countsOf(std::string_view text) {
  std::vector<std::size_t> counts;
  for (const LongList& list : longParameterLists(text)) counts.push_back(list.parameters);
  return counts;
}

TEST(FunctionRules, FindDeclarationsDefinitionsMembersConstructorsAndLambdas) {
  EXPECT_EQ(countsOf("void f(int a, int b, int c, int d, int e, int f, int g);"),
            std::vector<std::size_t>{7});
  EXPECT_EQ(countsOf("bool A::g(const Vec3& a, std::vector<int>* b, std::map<int, int> c, double d = 2.0,\n"
                     "          std::span<const int> e, const X& f, Y::Z g, bool h) const {"),
            std::vector<std::size_t>{8});
  EXPECT_EQ(countsOf("A(int a, int b, int c, int d, int e, int f, int g) : a_(a) {}"),
            std::vector<std::size_t>{7});
  EXPECT_EQ(countsOf("const auto f = [&](int a, int b, int c, int d, int e, int f, int g) {};"),
            std::vector<std::size_t>{7});
  const std::vector<LongList> named = longParameterLists(
      "\n\nint total(int a, int b, int c, int d, int e, int f, std::array<int, 3> g = {1, 2, 3});");
  ASSERT_EQ(named.size(), 1u);
  EXPECT_EQ(named[0].function, "total");
  EXPECT_EQ(named[0].line, 3);
}

TEST(FunctionRules, LetCallsShortListsCommentsAndStringsThrough) {
  EXPECT_TRUE(countsOf("void f(int a, int b, int c, int d, int e, int f);").empty());
  EXPECT_TRUE(countsOf("f(a, b, c, d, e, f, g, h);").empty());
  EXPECT_TRUE(countsOf("f(2 * a, b(c, d), x + y, \"s\", {1, 2}, e, g, h);").empty());
  EXPECT_TRUE(countsOf("// void f(int a, int b, int c, int d, int e, int f, int g);").empty());
  EXPECT_TRUE(countsOf("/* void f(int a, int b, int c,\n int d, int e, int f, int g); */").empty());
  EXPECT_TRUE(countsOf("const char* s = \"(int a, int b, int c, int d, int e, int f, int g)\";").empty());
  EXPECT_TRUE(
      countsOf("const char* s = R\"x((int a, int b, int c, int d, int e, int f, int g))x\";").empty());
  EXPECT_TRUE(
      countsOf("void f(std::map<int, std::pair<int, int>> a, std::tuple<int, int, int, int> b);").empty());
}

TEST(FunctionRules, FindMemoryOfAThreadInCodeAlone) {
  EXPECT_EQ(threadLocalLines("int a;\nstatic thread_local int b;  // thread_local\n"), std::vector<int>{2});
  EXPECT_TRUE(threadLocalLines("// thread_local\nconst char* s = \"thread_local\";").empty());
}

}  // namespace
}  // namespace carom::architecture
