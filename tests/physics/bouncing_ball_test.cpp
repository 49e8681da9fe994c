// A ball with e < 1 stops after sqrt(2h/g) (1 + e) / (1 - e) (experiments/bouncing_ball.h).

#include "tests/physics/experiments/bouncing_ball.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class BouncingBall : public testing::TestWithParam<std::tuple<double, double, double>> {};  // Hz, e, radius

// Below a speed that gravity gives in one and a half steps or within the window (0.2 m/s and less)
// restitution is none. Dropped so are the flights that remained, 2 v e / (1 - e) / g at most; and a ball that
// has landed within a step still settles for a few. Measured for e = 0.5: 1.400 s at 60 Hz, 1.329 at 240,
// of 1.3546.
TEST_P(BouncingBall, StopsAtTheClosedFormTime) {
  const auto [rate_hz, restitution, radius] = GetParam();
  const double cut = std::max(0.2, 1.5 * kGravity / rate_hz);
  const double dropped = 2.0 * cut * restitution / (1.0 - restitution) / kGravity;
  const double expected = closedFormBounceStop(1.0, restitution);
  const double stop = bounceStop(kCarom, 1.0, restitution, radius, rate_hz);
  EXPECT_GE(stop, expected - dropped - 1.0 / rate_hz);
  EXPECT_LE(stop, expected + 6.0 / rate_hz);
}

INSTANTIATE_TEST_SUITE_P(RatesAndBalls, BouncingBall,
                         testing::Combine(testing::Values(30.0, 60.0, 120.0, 240.0),
                                          testing::Values(0.3, 0.5, 0.7), testing::Values(0.05, 0.25)));

}  // namespace
}  // namespace carom::physics
