// A rod falls over on a floor without friction (experiments/falling_rod.h): its rate at every angle follows
// from energy, and its centre falls straight down.
//
// GOALS' closed form is met to 0.3 % at a thousand steps a second only. At 240 a bar of 0.1 x 1 m is 4.7 %
// off, and one of 0.02 m turns about its own length as well (w^2 up to 2.7 times what it should be); at 60
// both do, the bar by 51 % and the thin rod by far more, with 9 % of energy found.

#include "tests/physics/experiments/falling_rod.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

double worstRateError(const FallingRod& rod) {
  const RodFall fall = dropRod(kCarom, rod);
  EXPECT_GE(fall.steps, 5);
  EXPECT_LE(fall.aside_m, 1e-12) << "nothing pushes it aside";
  return std::abs(fall.worst);
}

TEST(FallingRod, TurnsAtTheClosedFormRate) {
  for (double thickness : {0.02, 0.1, 0.3})
    for (double length : {0.5, 1.0, 3.0})
      for (double heading : {0.0, 0.4})
        EXPECT_LE(worstRateError({.rate_hz = 1000.0,
                                  .length_m = length,
                                  .thickness_m = thickness * length,
                                  .heading = heading}),
                  5e-3)
            << thickness << " of " << length << " heading " << heading;
}

TEST(FallingRod, TurnsAtTheClosedFormRate_LessExactlyAt240StepsASecond) {
  EXPECT_LE(worstRateError({.rate_hz = 240.0, .thickness_m = 0.3}), 0.02);
  EXPECT_LE(worstRateError({.rate_hz = 240.0, .thickness_m = 0.1}), 0.06);
}

TEST(FallingRod, FallsStraightDown_AtEveryStep) {
  for (double rate_hz : {30.0, 60.0, 120.0, 240.0})
    for (double heading : {0.0, 0.4, 2.0})
      EXPECT_LE(dropRod(kCarom, {.rate_hz = rate_hz, .thickness_m = 0.1, .heading = heading}).aside_m, 1e-12);
}

// The thin rod's form is the limit of the one for a rod with edges.
TEST(FallingRod, ClosedFormTendsToThatOfAThinRod) {
  const FallingRod rod{.length_m = 0.8, .thickness_m = 1e-9};
  for (double a : {0.5, 0.9, 1.4}) {
    const double thin = 12.0 * kGravity * (std::cos(rod.start_angle) - std::cos(a)) /
                        (0.8 * (1.0 + 3.0 * std::sin(a) * std::sin(a)));
    EXPECT_NEAR(rod.closedFormRateSquared(a) / thin, 1.0, 1e-7) << a;
  }
}

}  // namespace
}  // namespace carom::physics
