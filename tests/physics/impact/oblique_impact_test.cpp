// A ball strikes a floor obliquely: it loses mu (1 + e) v_n, or 2/7 v_t where the cone lets it roll off, and
// spins by 5/2 of the loss over its radius (experiments/oblique_impact.h). Roundings of some 1e-15 are left.

#include "tests/physics/experiments/oblique_impact.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class ObliqueBlow : public testing::TestWithParam<std::tuple<double, double>> {  // Hz, radius
 protected:
  static void expectClosedForm(const ObliqueImpact& impact) {
    const ObliqueRebound rebound = reboundOf(kCarom, impact);
    SCOPED_TRACE(testing::Message() << "mu " << impact.friction << " e " << impact.restitution << " v_t "
                                    << impact.tangential_mps << " heading " << impact.heading);
    const double loss = impact.closedFormLoss(), spin = 2.5 * loss / impact.radius_m;
    EXPECT_NEAR(rebound.loss_mps, loss, 1e-12 * loss);
    EXPECT_NEAR(rebound.spin_radps, spin, 1e-12 * spin);
    EXPECT_NEAR(rebound.rise_mps, impact.restitution * impact.normal_mps, 1e-12);
    EXPECT_NEAR(rebound.aside_mps, 0.0, 1e-12);
  }
};

TEST_P(ObliqueBlow, OfASlidingBall_TakesMuTimesTheNormalImpulse) {
  const auto [rate_hz, radius_m] = GetParam();
  for (double friction : {0.05, 0.2, 0.4})
    for (double restitution : {0.0, 0.5, 1.0})
      for (double heading : {0.0, 0.6, 2.0}) {
        const ObliqueImpact impact{rate_hz, friction, restitution, 2.0, 6.0, heading, radius_m};
        ASSERT_FALSE(impact.sticks());
        expectClosedForm(impact);
      }
}

TEST_P(ObliqueBlow, OfABallThatSticks_LeavesItFiveSevenths) {
  const auto [rate_hz, radius_m] = GetParam();
  for (double tangential : {0.5, 2.0, 4.0})
    for (double restitution : {0.0, 0.5})
      for (double heading : {0.0, 0.6, 2.0}) {
        const ObliqueImpact impact{rate_hz, 0.9, restitution, 2.0, tangential, heading, radius_m};
        ASSERT_TRUE(impact.sticks());
        expectClosedForm(impact);
      }
}

INSTANTIATE_TEST_SUITE_P(RatesAndRadii, ObliqueBlow,
                         testing::Combine(testing::Values(30.0, 60.0, 240.0),
                                          testing::Values(0.05, 0.25, 1.0)));

}  // namespace
}  // namespace carom::physics
