// A block on a slope that holds it does not creep (experiments/sliding_block.h): in a minute, with the
// resting mode off, by less than a nanometre. The bar is GOALS'.

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"
#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {
namespace {

class Creep : public testing::TestWithParam<double> {};  // Hz

TEST_P(Creep, OfABlockOnASlope_IsLessThanANanometreAMinute) {
  for (double heading : {0.0, 0.4, 0.785})
    for (double turn : {0.0, 0.5}) {
      const Slope slope{.rate_hz = GetParam(),
                        .angle = radians(20.0),
                        .friction = 0.4,
                        .heading = heading,
                        .turn = turn,
                        .resting = false};
      EXPECT_LT(creepOf(kCarom, slope, 60.0), 1e-9) << "heading " << heading << " turn " << turn;
    }
}

// 97 % of what friction can hold.
TEST_P(Creep, IsLessThanANanometreAMinute_CloseToTheThreshold) {
  const Slope slope{.rate_hz = GetParam(),
                    .angle = std::atan(0.97 * 0.6),
                    .friction = 0.6,
                    .heading = 1.0,
                    .turn = 0.3,
                    .resting = false};
  EXPECT_LT(creepOf(kCarom, slope, 60.0), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rates, Creep, testing::Values(30.0, 60.0, 240.0));

}  // namespace
}  // namespace carom::physics
