// A thousand of the sweeps that `stress sweeps` judges by the million.

#include "tests/bench/queries/random_sweep.h"

#include <gtest/gtest.h>

namespace carom::bench {
namespace {

TEST(RandomSweeps, OfUpToAFullTurnMissNoContact) {
  const std::uint64_t seed = 11;
  RandomSweeps sweeps(seed);
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(sweeps.next()) << "seed " << seed << " sweep " << i;
  const SweepCounts& c = sweeps.counts();
  EXPECT_GT(c.impacts, 200);
  EXPECT_GT(c.sweeps - c.impacts - c.stopped, 200) << "clear sweeps";
  EXPECT_LE(static_cast<double>(c.queries), 10.0 * static_cast<double>(c.sweeps));
}

}  // namespace
}  // namespace carom::bench
