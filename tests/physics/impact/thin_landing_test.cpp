// A thin box lands without restitution: no step may end with more energy than it began with. `stress
// landings` does so a million times; held against the bar is what contact paths may lift a body by.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class ThinLanding : public testing::TestWithParam<double> {};  // length over width

TEST_P(ThinLanding, GainsNoEnergy) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    SmallWorld world(240.0);
    world.addPlane(rubbing(0.5));
    const double width = 0.3 / GetParam();
    Placement needle{Solid::box({0.3, width, 0.5 * width})};
    needle.X_WB.rotation = random.rotation();
    needle.X_WB.position = Vec3(0.0, 0.0, 0.2);
    needle.velocity = Vec3(random.uniform(-3.0, 3.0), 0.0, -5.0);
    needle.spin = 3.0 * random.direction();
    needle.material = rubbing(0.5);
    world.add(needle);
    world.start();
    const double blow = world.world().audit().kinetic_energy_J;
    const auto energy = [&] {
      const Audit now = world.world().audit();
      return now.kinetic_energy_J + now.potential_energy_J;
    };
    for (double before = energy(); world.world().time() < 0.5;) {
      world.step();
      const double now = energy();
      ASSERT_LE(now - before, 0.1 * blow) << world.world().time();
      before = now;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Aspects, ThinLanding, testing::Values(5.0, 20.0, 100.0));

// A needle of half a millimetre whirls over a smooth floor. Its times of impact are searched for by intervals
// over which it is proven to be clear: a chord that proves too little says which shorter one will do.
TEST(WhirlingNeedle, NeedsTwoTriesAnInterval) {
  SmallWorld world(120.0);
  world.addPlane(rubbing(0.0));
  Placement needle{Solid::box({0.06, 4e-4, 4e-4})};
  needle.X_WB = {Quat(0.433, 0.624, -0.085, -0.645).normalized(), Vec3(0.0, 0.0, 0.034)};
  needle.spin = {-47.0, -56.0, 27.5};
  needle.material = rubbing(0.0);
  world.add(needle);
  world.start();
  long tries = 0, intervals = 0;
  while (world.world().time() < 0.8) {
    world.step();
    tries += world.world().audit().last_step.newton_steps;
    intervals += world.world().audit().last_step.distance_queries;
  }
  EXPECT_GT(intervals, 5000);
  EXPECT_LE(tries, 2 * intervals);
}

}  // namespace
}  // namespace carom::physics
