// A smooth ball slides down a fixed one, which takes it along a curve, and leaves it where theory says
// (experiments/leaving_ball.h).

#include "tests/physics/experiments/leaving_ball.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

TEST(LeavingBall, LeavesWhereTheCosineIsTwoThirds) {
  for (const double rate_hz : {30.0, 60.0, 240.0, 1000.0})
    for (const double heading : {0.0, 0.8})
      for (const double begin : {0.005, 0.02, 0.3})
        EXPECT_LE(std::abs(leavingError(kCarom, rate_hz, heading, begin)), 1e-3)
            << rate_hz << " Hz, heading " << heading << ", from " << begin;
}

}  // namespace
}  // namespace carom::physics
