// The wave of a row of dominoes runs as sqrt(g l) (experiments/dominoes.h): a row four times as large runs
// twice as fast.
//
// 2.000 is met to 3e-4 from 60 steps a second on, whatever way the row heads: its substeps are then no longer
// than at 240 (tolerance::kFinePairs). At 30 it is 1.995 to 1.998, as the smaller row runs 0.2 % too fast.

#include "tests/physics/experiments/standing/dominoes.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

// With steps in the ratio of the times nothing is different but the window, which stops growing at a metre.
TEST(Dominoes, FourTimesAsLarge_RunTwiceAsFast) {
  for (double heading : {0.0, 0.5}) {
    const double small = dominoSpeed(kCarom, 1.0, 240.0, heading);
    EXPECT_NEAR(dominoSpeed(kCarom, 4.0, 240.0, heading) / small, 2.0, 2e-4) << heading;
    EXPECT_NEAR(dominoSpeed(kCarom, 4.0, 120.0, heading) / small, 2.0, 5e-4) << heading;
  }
}

TEST(Dominoes, FourTimesAsLarge_RunTwiceAsFast_AtTheSameSteps) {
  for (double heading : {0.0, 0.25, 0.5, 0.7, 1.0})
    for (double rate_hz : {30.0, 60.0, 120.0})
      EXPECT_NEAR(dominoSpeed(kCarom, 4.0, rate_hz, heading) / dominoSpeed(kCarom, 1.0, rate_hz, heading),
                  2.0, rate_hz < 60.0 ? 5e-3 : 3e-4)
          << rate_hz << " Hz, heading " << heading;
}

}  // namespace
}  // namespace carom::physics
