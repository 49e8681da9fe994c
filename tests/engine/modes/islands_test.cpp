// Islands against flooding the graph of who presses on whom.

#include "engine/modes/islands.h"

#include <gtest/gtest.h>

#include "tests/oracle/test_shapes.h"

namespace carom {
namespace {

using oracle::Random;

TEST(Islands, AreTheConnectedSetsNamedByTheirSmallest) {
  Random random(131);
  for (int i = 0; i < 300; ++i) {
    const int n = random.integer(1, 40);
    Islands islands(n);
    std::vector<int> label(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) label[static_cast<std::size_t>(k)] = k;
    for (int j = random.integer(0, n); j > 0; --j) {
      const int a = random.integer(0, n - 1), b = random.integer(0, n - 1);
      islands.join(a, b);
      const int keep = std::min(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
      const int drop = std::max(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
      for (int& l : label)
        if (l == drop) l = keep;
    }
    for (int k = 0; k < n; ++k) ASSERT_EQ(islands.of(k), label[static_cast<std::size_t>(k)]) << i;
  }
}

TEST(Islands, OfAChainJoinedFromEitherEndAreOne) {
  for (bool backwards : {false, true}) {
    Islands islands(1000);
    for (int i = 0; i < 999; ++i) islands.join(backwards ? 999 - i : i, backwards ? 998 - i : i + 1);
    EXPECT_EQ(islands.of(999), 0);
    EXPECT_EQ(islands.of(500), 0);
  }
}

TEST(Islands, JoinedWithThemselvesStayAlone) {
  Islands islands(3);
  islands.join(1, 1);
  EXPECT_EQ(islands.of(0), 0);
  EXPECT_EQ(islands.of(1), 1);
  EXPECT_EQ(islands.of(2), 2);
}

TEST(Islands, PartedAreAloneWhateverWasJoined) {
  Random random(132);
  Islands islands(60);
  for (int i = 0; i < 100; ++i) {
    for (int j = random.integer(0, 40); j > 0; --j)
      islands.join(random.integer(0, 59), random.integer(0, 59));
    islands.part(60 + i);
    for (int k = 0; k < 60 + i; ++k) ASSERT_EQ(islands.of(k), k) << i;
  }
}

}  // namespace
}  // namespace carom
