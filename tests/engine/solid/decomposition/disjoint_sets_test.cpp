#include "engine/solid/decomposition/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

// The oracle paints: every number has a colour, and joining repaints one with the lesser of the two.
TEST(DisjointSets, AreThoseOfPaintedNumbers) {
  oracle::Random random(5);
  for (int round = 0; round < 50; ++round) {
    const int n = 1 + static_cast<int>(random.uniform(0.0, 60.0));
    DisjointSets sets;
    std::vector<int> colours;
    for (int i = 0; i < n; ++i) {
      ASSERT_EQ(sets.add(), i);
      colours.push_back(i);
    }
    ASSERT_EQ(sets.count(), n);
    for (int k = 0; k < n; ++k) {
      const int a = static_cast<int>(random.uniform(0.0, n)), b = static_cast<int>(random.uniform(0.0, n));
      sets.join(a, b);
      const int kept = std::min(colours[at(a)], colours[at(b)]),
                gone = std::max(colours[at(a)], colours[at(b)]);
      std::replace(colours.begin(), colours.end(), gone, kept);
      for (int i = 0; i < n; ++i) ASSERT_EQ(sets.rootOf(i), colours[at(i)]) << round << ", " << i;
    }
  }
}

}  // namespace
}  // namespace carom
