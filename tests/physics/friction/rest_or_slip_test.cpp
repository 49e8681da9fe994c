// Resting never lies: six flat solids on slopes of 1 to 60 degrees with friction of 0 to 1.5 stay exactly
// when tan <= mu, outside 0.1 % of it (experiments/rest_or_slip.h).
//
// The resting mode holds what would gain less than 1e-3 m/s^2: up to 0.1 % beyond mu = 0.1, and less beyond a
// larger one (at 0.03 % those with mu of 0.1 to 0.3). At 0.01 % to this side nothing slides, as it should.

#include "tests/physics/experiments/rest_or_slip.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class RestOrSlip : public testing::TestWithParam<double> {};  // Hz

TEST_P(RestOrSlip, AgreesWithTheory_ForSixSolidsOnEverySlope) {
  const Verdicts verdicts = restOrSlip(kCarom, GetParam());
  EXPECT_GT(verdicts.asked, 1300);
  EXPECT_EQ(verdicts.held_wrongly, 0);
  EXPECT_EQ(verdicts.slid_wrongly, 0);
}

INSTANTIATE_TEST_SUITE_P(Rates, RestOrSlip, testing::Values(60.0, 240.0));

}  // namespace
}  // namespace carom::physics
