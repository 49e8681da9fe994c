// Painlevé's rod (experiments/painleve_rod.h): in the region without a finite force the tip is stopped by a
// finite impulse, and nothing gains energy.

#include "tests/physics/experiments/painleve_rod.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class Painleve : public testing::TestWithParam<std::tuple<double, double>> {};  // mu, heading

TEST_P(Painleve, RodIsStoppedByAFiniteImpulse_WithoutGainOfEnergy) {
  const auto [friction, heading] = GetParam();
  for (double rate_hz : {30.0, 60.0, 120.0, 240.0, 1000.0}) {
    const PainleveRod rod{.rate_hz = rate_hz, .friction = friction, .heading = heading};
    const PainleveOutcome outcome = slidePainleveRod(kCarom, rod);
    EXPECT_LE(outcome.energy_gain, 1e-12) << rate_hz;
    EXPECT_LE(outcome.fastest, 1.0) << "faster than all of its energy allows";
    EXPECT_LT(outcome.end_energy, 0.9) << "friction should have taken some";
  }
}

INSTANTIATE_TEST_SUITE_P(FrictionAndHeading, Painleve,
                         testing::Combine(testing::Values(0.5, 1.2, 1.4, 2.0), testing::Values(0.0, 0.4)));

TEST(PainleveRegion, BeginsAtFourThirds) {
  EXPECT_GT(PainleveRod{.friction = 1.33}.inverseMass(), 0.0);
  EXPECT_LT(PainleveRod{.friction = 1.34}.inverseMass(), 0.0);
}

}  // namespace
}  // namespace carom::physics
