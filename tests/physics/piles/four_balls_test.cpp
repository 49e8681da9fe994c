// One ball on three that touch (experiments/standing/four_balls.h): they stand by friction between them and
// below them.

#include "tests/physics/experiments/standing/four_balls.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class FourBallsTest : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, radius

TEST_P(FourBallsTest, StandAThousandthAboveTheirFrictions_AndRollApartAThousandthBelow) {
  const double rate_hz = std::get<0>(GetParam()), radius = std::get<1>(GetParam());
  const double least = leastFrictionOfBalls();
  for (const double heading : {0.0, 0.5}) {
    const FourBalls balls{.rate_hz = rate_hz, .radius_m = radius, .heading = heading};
    const auto drop = [&](double between, double below) {
      FourBalls these = balls;
      these.between = between;
      these.below = below;
      return fourBallsDrop(kCarom, these, 5.0) / radius;
    };
    EXPECT_LE(std::abs(drop(1.001 * least, 0.5)), 1e-6) << heading;
    EXPECT_LE(std::abs(drop(0.6, 1.001 * least / 4.0)), 1e-6) << heading;
    EXPECT_GT(drop(0.999 * least, 0.5), 0.1) << heading;
    EXPECT_GT(drop(0.6, 0.999 * least / 4.0), 0.1) << heading;
  }
}

INSTANTIATE_TEST_SUITE_P(RatesAndSizes, FourBallsTest,
                         testing::Combine(testing::Values(30.0, 60.0, 240.0), testing::Values(0.02, 0.5)));

}  // namespace
}  // namespace carom::physics
