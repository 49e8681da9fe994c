// A rod falls over on a floor without friction (experiments/falling_rod.h): its rate at every angle follows
// from energy, and its centre falls straight down.
//
// Its error goes with the square of the (sub)step: for a rod of 1 m it is 0.01 % from 60 to 240 steps a
// second and 1e-5 at 1000, and twice that for half a metre, whatever the thickness. At 30 it is up to 0.05 %.
// What is smaller falls in less time: its substeps are shorter (tolerance::kFineFall), or 5 mm at 240 Hz
// would be 3 % off.

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

TEST(FallingRod, TurnsAtTheClosedFormRate_ToTheSquareOfTheStep) {
  for (double rate_hz : {60.0, 120.0, 240.0, 1000.0})
    for (double length : {0.5, 1.0, 3.0})
      for (double thickness : {0.02, 0.1, 0.3})
        for (double heading : {0.0, 0.4})
          EXPECT_LE(worstRateError({.rate_hz = rate_hz,
                                    .length_m = length,
                                    .thickness_m = thickness * length,
                                    .heading = heading}),
                    2e-4 / length * std::pow(240.0 / std::max(rate_hz, 240.0), 2))
              << rate_hz << " Hz, " << length << " m, " << thickness << " of it, heading " << heading;
}

TEST(FallingRod, TurnsAtTheClosedFormRate_HoweverSmallItIs) {
  const double bound =
      0.4 * tolerance::kFineFall;  // the error of 1 m at 240 Hz, where h^2 g / r is 3.4e-4, is 1e-4
  for (double rate_hz : {240.0, 1000.0})
    for (double length : {0.2, 0.1, 0.05, 0.02, 0.01, 0.005})
      EXPECT_LE(worstRateError({.rate_hz = rate_hz, .length_m = length, .thickness_m = 0.1 * length}), bound)
          << rate_hz << " Hz, " << length << " m";
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
