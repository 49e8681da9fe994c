// The engine adds in an order of its own: Eigen's scalar product, and what Eigen makes of it, adds in another
// order from version to version (engine/foundation/dot.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "tests/architecture/function_rules.h"
#include "tests/architecture/source_tree.h"

namespace carom::architecture {
namespace {

/// The lines on which Eigen is asked for a scalar product.
std::vector<int> linesOfEigensProducts(std::string_view text) {
  static const std::regex kProducts(
      "(\\.|->)\\s*(dot|slerp|angularDistance)\\s*\\(|\\b(F|setF)romTwoVectors\\s*\\(");
  const std::string code = codeOf(text);
  std::vector<int> lines;
  for (std::sregex_iterator at(code.begin(), code.end(), kProducts), end; at != end; ++at)
    lines.push_back(static_cast<int>(1 + std::count(code.begin(), code.begin() + at->position(), '\n')));
  return lines;
}

TEST(ScalarProductsOfTheEngine, AreItsOwn) {
  std::size_t sources = 0;
  for (const auto& [path, text] : sourcesOfTheTree({"engine"})) {
    ++sources;
    for (const int line : linesOfEigensProducts(text))
      ADD_FAILURE() << path << ":" << line << ": write dot(a, b); Eigen's order of additions is its own";
  }
  EXPECT_GT(sources, 100u);
}

TEST(ScalarProductsOfAText, AreThoseOfEigenAlone) {
  EXPECT_EQ(linesOfEigensProducts("double a = b.dot(c);\nd->dot (e);\nf\n.dot(g);"), (std::vector{1, 2, 4}));
  EXPECT_EQ(linesOfEigensProducts("q = Quat::FromTwoVectors(a, b);\nq.slerp(0.5, p);\nq.angularDistance(p);"),
            (std::vector{1, 2, 3}));
  EXPECT_TRUE(
      linesOfEigensProducts("dot(a, b); a.dots(b); a.squaredNorm();  // a.dot(b)\n\"a.dot(b)\"").empty());
}

}  // namespace
}  // namespace carom::architecture
