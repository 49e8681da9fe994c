// A name of a constant means one number, wherever in the engine it is read.

#include <gtest/gtest.h>

#include <map>

#include "tests/architecture/constant_rules.h"
#include "tests/architecture/source_tree.h"

namespace carom::architecture {
namespace {

struct Place {
  std::string value, where;
};

TEST(Constants, HaveOneValueAName) {
  std::map<std::string, Place> first;
  for (const auto& [path, text] : sourcesOfTheTree({"engine"}))
    for (const Constant& constant : constantsOf(text)) {
      const std::string where = path + ":" + std::to_string(constant.line);
      const Place& place = first.try_emplace(constant.name, Place{constant.value, where}).first->second;
      EXPECT_EQ(constant.value, place.value)
          << constant.name << " of " << where << " is another at " << place.where << "; say what each is";
    }
  EXPECT_GT(first.size(), 250u);
}

// The reader itself.

std::string shown(std::string_view text) {
  std::string shown;
  for (const Constant& c : constantsOf(text))
    shown += c.name + " " + c.value + " " + std::to_string(c.line) + "\n";
  return shown;
}

TEST(ConstantRules, FindNamesWithTheirValues) {
  EXPECT_EQ(shown("constexpr double kA = 2.0 *\n    kB;  // kC = 3\n"), "kA 2.0*kB 1\n");
  EXPECT_EQ(shown("\nstatic constexpr std::size_t kA = 24, kB = f(1, 2);"), "kA 24 2\nkB f(1,2) 2\n");
  EXPECT_EQ(shown("inline constexpr std::array<int, 2> kA{1, 2};"), "kA {1,2} 1\n");
  EXPECT_EQ(shown("static constexpr const char* kA[] = {\"a\", \"b\"};"), "kA {\"\",\"\"} 1\n");
  EXPECT_EQ(shown("const std::set<int> kA = {1};\nconstexpr int kA = 1;"), "kA {1} 1\nkA 1 2\n");
}

TEST(ConstantRules, LetFunctionsVariablesAndEnumeratorsThrough) {
  EXPECT_EQ(shown("constexpr double f(double x = kA) { return x; }"), "");
  EXPECT_EQ(shown("const double a = kA;\nvoid f(const Vec3& a, int b = kB);"), "");
  EXPECT_EQ(shown("double at() const { const int b = kA; return b == kB; }"), "");
  EXPECT_EQ(shown("enum class A { kA = 1, kB };"), "");
}

}  // namespace
}  // namespace carom::architecture
