// Bouncing on the floor: apex heights e^2k h, energy kept at e = 1, and the collision window's share in them.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

struct Bouncer {
  const char* name;
  Solid solid;
  Quat rotation;
  double lowest_m;  ///< From the centre to the lowest point.
  double width_m;
};

std::vector<Bouncer> bouncers() {
  return {{"ball", Solid::ball(0.25), Quat::Identity(), 0.25, 0.5},
          {"box", Solid::box({0.4, 0.6, 0.3}), oracle::turned(Vec3::UnitZ(), 0.5), 0.15, 0.3}};
}

// The height to which the body would rise over its place on the floor; constant along a parabola.
double apex(const SmallWorld& w, int body, double lowest) {
  const double vz = w.velocity(body).z();
  return w.position(body).z() - lowest + vz * vz / (2.0 * kGravity);
}

class Restitution : public testing::TestWithParam<double> {};

// The bodies are struck at a gap g with 0 < g < ceiling, and so apex' = e^2 apex + (1 - e^2) g: from above,
// 0 <= apex_k - e^2k h <= ceiling.
TEST_P(Restitution, ApexFallsByTheSquareOfIt) {
  const double rate = GetParam();
  for (const Bouncer& b : bouncers())
    for (const double e : {0.5, 0.8, 1.0}) {
      const double h = 1.0, ceiling = windowCeiling(b.width_m);
      SmallWorld w(rate);
      w.addPlane(rubbing(0.3, 0.0));
      const int body = w.add({b.solid,
                              {b.rotation, Vec3(0.3, -0.2, b.lowest_m + h)},
                              Vec3::Zero(),
                              Vec3::Zero(),
                              rubbing(0.3, e)});
      w.start();
      int bounces = 0;
      double expected = h, vz = 0.0;
      while (w.time() < 20.0 && expected > 0.03) {
        w.step();
        if (vz < 0.0 && w.velocity(body).z() > 0.0) {
          ++bounces;
          expected *= e * e;
        }
        vz = w.velocity(body).z();
        ASSERT_GE(apex(w, body, b.lowest_m), expected - 1e-9)
            << b.name << " e " << e << " bounce " << bounces;
        ASSERT_LE(apex(w, body, b.lowest_m), expected + ceiling)
            << b.name << " e " << e << " bounce " << bounces;
      }
      const double period = 2.0 * std::sqrt(2.0 * h / kGravity);
      EXPECT_GE(bounces, e == 1.0 ? static_cast<int>(20.0 / period) - 1 : (e == 0.5 ? 2 : 7)) << b.name;
      EXPECT_LT(w.spin(body).norm(), 1e-9) << b.name;
    }
}

TEST_P(Restitution, OfOneKeepsTheEnergyForTwentySeconds) {
  for (const Bouncer& b : bouncers()) {
    SmallWorld w(GetParam());
    w.addPlane(rubbing(0.3));
    w.add(
        {b.solid, {b.rotation, Vec3(0, 0, b.lowest_m + 0.5)}, Vec3::Zero(), Vec3::Zero(), rubbing(0.3, 1.0)});
    w.start();
    const Audit begin = w.world().audit();
    const double energy = begin.kinetic_energy_J + begin.potential_energy_J;
    while (w.time() < 20.0) {
      w.step();
      const Audit now = w.world().audit();
      ASSERT_NEAR(now.kinetic_energy_J + now.potential_energy_J, energy, 1e-9 * energy)
          << b.name << " at " << w.time();
    }
  }
}

TEST_P(Restitution, OfZeroLeavesABallOnTheFloorAtItsRestGap) {
  SmallWorld w(GetParam());
  w.addPlane(rubbing(0.3));
  const int ball = w.add({Solid::ball(0.25),
                          {Quat::Identity(), Vec3(0, 0, 1.25)},
                          Vec3::Zero(),
                          Vec3::Zero(),
                          rubbing(0.3, 0.0)});
  w.start();
  const double landing = std::sqrt(2.0 * 1.0 / kGravity);
  while (w.time() < landing + 2.0 / GetParam()) w.step();
  EXPECT_LT(std::abs(w.velocity(ball).z()), 2.0 * kGravity / GetParam()) << "no rebound";
  w.run(2.0);
  EXPECT_TRUE(w.rests(ball)) << modeName(w.state(ball).mode) << " v " << w.velocity(ball).transpose();
  EXPECT_NEAR(w.position(ball).z() - 0.25, restGap(0.5), 0.2 * restGap(0.5));
}

INSTANTIATE_TEST_SUITE_P(Rates, Restitution, testing::Values(60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
