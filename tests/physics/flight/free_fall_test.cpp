// Free flight against the closed form: the parabola is exact at every step size, and nothing drags.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// Each step rounds position and velocity once or twice: after n steps the error is below 4 n eps (|x| + |v|
// T).
double roundingBound(int steps, const Vec3& x, const Vec3& v, double seconds) {
  return 4.0 * steps * 0x1p-53 * (x.norm() + v.norm() * seconds + 0.5 * kGravity * seconds * seconds);
}

class FreeFall : public testing::TestWithParam<double> {};

TEST_P(FreeFall, FollowsTheParabolaToRounding) {
  const double seconds = 3.0;
  for (const bool spinning : {false, true}) {
    SmallWorld w(GetParam());
    const Vec3 x0(1.3, -2.7, 40.0), v0(3.1, -1.9, 11.3);
    const int body = w.add({Solid::box({0.3, 0.7, 0.2}),
                            {oracle::turned({1, 2, 3}, 0.7), x0},
                            v0,
                            spinning ? Vec3(2.0, -5.0, 1.0) : Vec3::Zero()});
    w.start();
    while (w.time() < seconds - 1e-9) {
      w.step();
      const double t = w.time();
      const double bound = roundingBound(w.world().stepCount(), x0, v0, t);
      ASSERT_LT((w.position(body) - (x0 + t * v0 + 0.5 * t * t * Vec3(0, 0, -kGravity))).norm(), bound);
      ASSERT_LT((w.velocity(body) - (v0 + t * Vec3(0, 0, -kGravity))).norm(), bound);
      ASSERT_EQ(w.state(body).mode, Mode::kFree);
    }
  }
}

TEST_P(FreeFall, KeepsTheEnergyOfAThrownBall) {
  SmallWorld w(GetParam());
  w.add({Solid::ball(0.2), {Quat::Identity(), Vec3(0, 0, 5)}, Vec3(4, 1, 6), Vec3(1, 2, 3)});
  w.start();
  const Audit before = w.world().audit();
  const double energy = before.kinetic_energy_J + before.potential_energy_J;
  w.run(2.0);
  const Audit after = w.world().audit();
  EXPECT_NEAR(after.kinetic_energy_J + after.potential_energy_J, energy, 1e-12 * energy);
}

TEST_P(FreeFall, KeepsTheAngularMomentumOfATumblingBox) {
  SmallWorld w(GetParam(), Vec3::Zero());
  const int body = w.add({Solid::box({0.1, 0.5, 1.1}),
                          {oracle::turned({3, -1, 2}, 1.1), Vec3::Zero()},
                          Vec3::Zero(),
                          Vec3(1.0, 7.0, -2.0)});
  w.start();
  const Vec3 before = w.world().audit().angular_momentum;
  const Vec3 spin = w.spin(body);
  w.run(5.0);
  const double rounding = 16.0 * w.world().stepCount() * 0x1p-53;  // a handful of roundings a step
  EXPECT_LT((w.world().audit().angular_momentum - before).norm(), rounding * before.norm());
  EXPECT_GT((w.spin(body) - spin).norm(), 0.1) << "the box should tumble: its spin is not constant";
}

TEST_P(FreeFall, InAnySlantedGravityFollowsIt) {
  const Vec3 gravity(1.5, -2.0, -3.0);
  SmallWorld w(GetParam(), gravity);
  const int body = w.add({Solid::ball(0.3), {Quat::Identity(), Vec3(1, 2, 3)}, Vec3(-1, 0.5, 2)});
  w.start();
  w.run(2.0);
  EXPECT_LT((w.position(body) - (Vec3(1, 2, 3) + 2.0 * Vec3(-1, 0.5, 2) + 2.0 * gravity)).norm(), 1e-12);
}

// Gravity's sign and its potential agree: falling turns one into the other.
TEST(Gravity, PotentialFallsAsMuchAsKineticEnergyRises) {
  SmallWorld w;
  const int body = w.add({Solid::box({1, 2, 0.5}), {oracle::turned({1, 0, 2}, 0.3), Vec3(0, 0, 7)}});
  w.start();
  w.run(1.0);
  const double mass = w.world().mass(body);
  EXPECT_NEAR(mass, 1000.0, 1e-9);
  EXPECT_NEAR(w.world().audit().kinetic_energy_J, 0.5 * mass * kGravity * kGravity, 1e-6);
  EXPECT_NEAR(w.world().audit().potential_energy_J, mass * kGravity * (7.0 - 0.5 * kGravity), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Rates, FreeFall, testing::Values(24.0, 60.0, 120.0, 240.0, 1000.0));

}  // namespace
}  // namespace carom::physics
