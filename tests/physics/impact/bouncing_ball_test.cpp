// A ball with e < 1 stops after sqrt(2h/g) (1 + e) / (1 - e) (experiments/bouncing_ball.h).

#include "tests/physics/experiments/bouncing_ball.h"

#include <gtest/gtest.h>

#include "engine/contact/collision_window.h"

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class BouncingBall : public testing::TestWithParam<std::tuple<double, double, double>> {};  // Hz, e, radius

// A bounce that would last for less than a substep is none. Dropped so are it and those after it, which take
// 1 / (1 - e) of it at most. The last one that counts begins and ends somewhere in the collision window,
// whose half it falls through in the less time the longer it lasts. Looked at is the end of every step: it
// may have stopped just after one, or just have been slow there.
TEST_P(BouncingBall, StopsAtTheClosedFormTime) {
  const auto [rate_hz, restitution, radius] = GetParam();
  const double dropped = std::min(1.0 / rate_hz, 1.0 / 240.0) / (1.0 - restitution);
  const double expected = closedFormBounceStop(1.0, restitution);
  const double stop = bounceStop(kCarom, 1.0, restitution, radius, rate_hz);
  const double window =
      0.5 * collisionWindow(2.0 * radius).ceiling / (0.5 * kGravity / 240.0) / (1.0 - restitution);
  EXPECT_GE(stop, expected - dropped - window - 2.0 / rate_hz);
  EXPECT_LE(stop, expected + 1.0 / rate_hz);
}

INSTANTIATE_TEST_SUITE_P(RatesAndBalls, BouncingBall,
                         testing::Combine(testing::Values(30.0, 60.0, 120.0, 240.0),
                                          testing::Values(0.3, 0.5, 0.7), testing::Values(0.05, 0.25)));

}  // namespace
}  // namespace carom::physics
