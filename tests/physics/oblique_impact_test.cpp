// A ball strikes a floor obliquely: it loses mu (1 + e) v_n, or 2/7 v_t where the cone lets it roll off
// (experiments/oblique_impact.h).
//
// Blows act in the middle of the gap G at which bodies are struck (the landing gap), so the lever is
// R = r + G/2, and 2/5 / (2/5 + R^2/r^2) takes the place of 2/7: less by 5/7 G/r, 0.21 % up to half a metre
// of radius. The time of impact finds G to a hundredth, which is worth 1.5e-5 of a spin and 6e-6 of v_t.
// Sliding has no lever in it. GOALS wants the closed forms themselves: sticking misses them by the gap.

#include "tests/physics/experiments/oblique_impact.h"

#include <gtest/gtest.h>

#include "tests/physics/experiments/carom_simulation.h"

namespace carom::physics {
namespace {

class ObliqueBlow : public testing::TestWithParam<std::tuple<double, double>> {  // Hz, radius
 protected:
  double rate_hz() const { return std::get<0>(GetParam()); }
  double radius_m() const { return std::get<1>(GetParam()); }
  /// R / r.
  double lever() const {
    const double gap = tolerance::kLandingGap * std::min(2.0 * radius_m(), tolerance::kWindowLargestScale);
    return 1.0 + 0.5 * gap / radius_m();
  }
};

TEST_P(ObliqueBlow, OfASlidingBall_TakesMuTimesTheNormalImpulse) {
  for (double friction : {0.05, 0.2, 0.4})
    for (double restitution : {0.0, 0.5, 1.0})
      for (double heading : {0.0, 0.6, 2.0}) {
        const ObliqueImpact impact{rate_hz(), friction, restitution, 2.0, 6.0, heading, radius_m()};
        ASSERT_FALSE(impact.sticks());
        const ObliqueRebound rebound = reboundOf(kCarom, impact);
        SCOPED_TRACE(testing::Message()
                     << "mu " << friction << " e " << restitution << " heading " << heading);
        if (restitution > 0.0) {
          EXPECT_NEAR(rebound.loss_mps, impact.closedFormLoss(), 1e-12 * impact.tangential_mps);
          EXPECT_NEAR(rebound.spin_radps, 2.5 * impact.closedFormLoss() * lever() / radius_m(),
                      1.5e-5 * rebound.spin_radps);
        }
        EXPECT_NEAR(rebound.rise_mps, restitution * impact.normal_mps,
                    1e-12 + (restitution > 0.0 ? 0.0 : 1e-2));
        EXPECT_NEAR(rebound.aside_mps, 0.0, 1e-12);
      }
}

TEST_P(ObliqueBlow, OfABallThatSticks_LeavesItFiveSevenths_ButForTheGap) {
  for (double tangential : {0.5, 2.0, 4.0})
    for (double heading : {0.0, 0.6, 2.0}) {
      const ObliqueImpact impact{rate_hz(), 0.9, 0.5, 2.0, tangential, heading, radius_m()};
      ASSERT_TRUE(impact.sticks());
      const ObliqueRebound rebound = reboundOf(kCarom, impact);
      const double with_gap = 0.4 / (0.4 + lever() * lever()) * tangential;
      SCOPED_TRACE(testing::Message() << "v_t " << tangential << " heading " << heading);
      EXPECT_NEAR(rebound.loss_mps, with_gap, 6e-6 * tangential);
      EXPECT_NEAR(rebound.loss_mps / impact.closedFormLoss(), 1.0, 2.2e-3);
      EXPECT_NEAR(rebound.rise_mps, 1.0, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(RatesAndRadii, ObliqueBlow,
                         testing::Combine(testing::Values(30.0, 60.0, 240.0),
                                          testing::Values(0.05, 0.25, 1.0)));

}  // namespace
}  // namespace carom::physics
