// A minute of bouncing at e = 1 without friction: the energy of the start is the energy of the end, at any
// step. The oracle is conservation alone; an upright fall also has its closed-form period.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

struct Bouncer {
  const char* name;
  Solid solid;
  Quat rotation;
  double tolerance;  ///< Relative to the energy at the start.
};

// The first three keep their spin between bounces, so that nothing but rounding is left: a few roundings of
// each of 14 400 steps, 1e-9 with room. The last tumbles, and every impact hangs on its exact orientation.
std::vector<Bouncer> bouncers() {
  const Quat tilt = oracle::turned({1.0, 0.4, 0.2}, 0.6);
  return {{"ball", Solid::ball(0.25), Quat::Identity(), 1e-9},
          {"flat cube", Solid::box(Vec3::Constant(0.5)), oracle::turned(Vec3::UnitZ(), 0.3), 1e-9},
          {"tilted cube", Solid::box(Vec3::Constant(0.5)), tilt, 1e-9},
          {"tilted box", Solid::box({0.5, 0.3, 0.7}), tilt, 1e-9}};
}

class ElasticMinute : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(ElasticMinute, KeepsTheEnergyItBeganWith) {
  const auto [index, rate_hz] = GetParam();
  const Bouncer b = bouncers()[static_cast<std::size_t>(index)];
  SmallWorld w(rate_hz);
  w.addPlane(rubbing(0.0, 1.0));
  w.add({b.solid, {b.rotation, Vec3(0, 0, 1.5)}, Vec3::Zero(), Vec3::Zero(), rubbing(0.0, 1.0)});
  w.start();
  const auto energy = [&w] {
    const Audit now = w.world().audit();
    return now.kinetic_energy_J + now.potential_energy_J;
  };
  const double begin = energy();
  double lost = 0.0, gained = 0.0;
  int events = 0, held = 0;
  for (int i = 0; i < static_cast<int>(60.0 * rate_hz); ++i) {
    w.step();
    lost = std::max(lost, 1.0 - energy() / begin);
    gained = std::max(gained, energy() / begin - 1.0);
    events += w.world().audit().last_step.events;
    held += w.world().audit().last_step.stopped_bodies;
  }
  EXPECT_LE(lost, b.tolerance) << b.name;
  EXPECT_LE(gained, b.tolerance) << b.name;
  EXPECT_GT(events, 50) << b.name << " should have bounced at least once a second";
  EXPECT_EQ(held, 0) << b.name;
}

class SlowMeeting : public testing::TestWithParam<std::tuple<double, double>> {};  // m/s, Hz

// Two balls that fall side by side and meet slowly: however slow, they part as fast as they met.
TEST_P(SlowMeeting, OfFallingElasticBalls_PartsThemAsFastAsTheyMet) {
  const auto [speed, rate_hz] = GetParam();
  SmallWorld w(rate_hz);
  const auto ball = [&w](double x, double v) {
    return w.add({Solid::ball(0.1),
                  {Quat::Identity(), Vec3(x, 0, 0)},
                  Vec3(v, 0, 0),
                  Vec3::Zero(),
                  rubbing(0.0, 1.0)});
  };
  const int a = ball(0.0, 0.5 * speed), b = ball(0.2 + 0.25 * speed, -0.5 * speed);
  w.start();
  w.run(0.5);
  EXPECT_NEAR(w.velocity(b).x(), 0.5 * speed, 1e-9);
  EXPECT_NEAR(w.velocity(a).x(), -0.5 * speed, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(SpeedsAndRates, SlowMeeting,
                         testing::Combine(testing::Values(0.02, 0.05, 0.1, 0.2, 0.5, 2.0),
                                          testing::Values(60.0, 240.0, 1000.0)));

INSTANTIATE_TEST_SUITE_P(BodiesAndRates, ElasticMinute,
                         testing::Combine(testing::Range(0, 4), testing::Values(30.0, 60.0, 240.0)));

}  // namespace
}  // namespace carom::physics
