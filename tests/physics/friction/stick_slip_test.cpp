// The threshold of friction: a block on a slope stays exactly when tan(angle) <= mu, to a thousandth. One
// that would gain less than 2e-4 m/s^2 is held by the resting mode: it stays up to 0.01 % beyond mu = 0.2,
// and up to 0.003 % beyond 0.9. What stays moves by less than a micrometre; what slides has the closed form's
// speed to 6e-5, and to the step in which it gets loose.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kMargin = 1e-3;  // the bar: 0.1 % either side

struct Outcome {
  double slid_m = 0.0;
  double speed_mps = 0.0;
  bool rests = false;
};

Outcome leaveOnSlope(double tangent, double static_friction, double dynamic_friction, double heading,
                     double turn, double rate) {
  const Quat tilt =
      oracle::turned(Vec3::UnitZ(), heading) * oracle::turned(Vec3::UnitY(), std::atan(tangent));
  const Material material{static_friction, dynamic_friction, 0.0, 1000.0};
  const Vec3 size(0.6, 0.5, 0.2);
  SmallWorld w(rate);
  w.addPlane(material, tilt);
  const Pose X = lyingBox(size, tilt, turn);
  const int block = w.add({Solid::box(size), X, Vec3::Zero(), Vec3::Zero(), material});
  w.start();
  w.run(3.0);
  return {(w.position(block) - X.position).norm(), w.velocity(block).norm(), w.rests(block)};
}

class StickSlip : public testing::TestWithParam<double> {};

TEST_P(StickSlip, ABlockJustBelowTheThresholdRestsWhereItWasPut) {
  for (double mu : {0.2, 0.5, 0.9})
    for (double turn : {0.0, 0.6}) {
      const Outcome o = leaveOnSlope(mu * (1.0 - kMargin), mu, mu, 0.4, turn, GetParam());
      EXPECT_TRUE(o.rests) << "mu " << mu << " turn " << turn << " speed " << o.speed_mps;
      EXPECT_LT(o.slid_m, 1e-6) << "mu " << mu << " turn " << turn;
    }
}

TEST_P(StickSlip, ABlockJustAboveTheThresholdSlidesByTheClosedForm) {
  for (double mu : {0.2, 0.5, 0.9})
    for (double turn : {0.0, 0.6}) {
      const double tangent = mu * (1.0 + kMargin);
      const Outcome o = leaveOnSlope(tangent, mu, mu, 0.4, turn, GetParam());
      const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
      const double expected = kGravity * cosine * (tangent - mu) * 3.0;
      EXPECT_FALSE(o.rests) << "mu " << mu << " turn " << turn;
      EXPECT_NEAR(o.speed_mps / expected, 1.0, 1e-4) << "mu " << mu << " turn " << turn;
    }
}

TEST_P(StickSlip, TheStaticCoefficientDecidesWhetherTheDynamicOneHowFast) {
  const double mu_s = 0.6, mu_d = 0.4;
  const Outcome below = leaveOnSlope(mu_s * (1.0 - kMargin), mu_s, mu_d, 0.2, 0.3, GetParam());
  EXPECT_TRUE(below.rests);
  EXPECT_LT(below.slid_m, 1e-6);
  const double tangent = mu_s * (1.0 + kMargin);
  const Outcome above = leaveOnSlope(tangent, mu_s, mu_d, 0.2, 0.3, GetParam());
  const double expected = kGravity / std::sqrt(1.0 + tangent * tangent) * (tangent - mu_d) * 3.0;
  // The static coefficient holds it for the first step of the three seconds.
  EXPECT_NEAR(above.speed_mps / expected, 1.0, 0.36 / GetParam());
}

INSTANTIATE_TEST_SUITE_P(Rates, StickSlip, testing::Values(60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
