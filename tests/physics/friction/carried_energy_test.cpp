// Bodies in lasting contact that are struck in the middle of a step. A collision must find the momentum that
// they have then: not what the whole step's gravity will have given them.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"
#include "tests/support/world_energy.h"

namespace carom::physics {
namespace {

class Trough : public testing::TestWithParam<std::tuple<double, std::uint64_t>> {};  // Hz, seed

// Eight elastic balls run along a smooth trough and into each other; four more fall among them.
TEST_P(Trough, OfElasticBalls_NeverGainsEnergy) {
  const auto [rate_hz, seed] = GetParam();
  SmallWorld w(rate_hz);
  const Material smooth = rubbing(0.0, 1.0);
  for (double side : {-1.0, 1.0}) {
    const Quat tilt = oracle::turned(Vec3::UnitY(), 0.7 * side);
    w.add({Solid::box({6, 60, 1}),
           {tilt, tilt * Vec3(-3.0 * side, 0, -0.5)},
           Vec3::Zero(),
           Vec3::Zero(),
           smooth,
           true});
  }
  oracle::Random random(seed);
  const double height = 0.1 / std::cos(0.7) + 0.0015;
  const auto ball = [&](const Vec3& place, double speed) {
    w.add({Solid::ball(0.1), {Quat::Identity(), place}, Vec3(0, speed, 0), Vec3::Zero(), smooth});
  };
  for (int i = 0; i < 8; ++i) ball(Vec3(0, -2.0 + 0.5 * i, height), random.uniform(-2.0, 2.0));
  for (int i = 0; i < 4; ++i)
    ball(Vec3(random.uniform(-0.3, 0.3), -1.7 + 0.9 * i, 1.0 + 0.3 * i), random.uniform(-1.0, 1.0));
  w.start();
  const double begin = energyOf(w.world());
  int events = 0;
  for (int i = 0; i < static_cast<int>(20.0 * rate_hz); ++i) {
    w.step();
    events += w.world().audit().last_step.events;
    ASSERT_LE(energyOf(w.world()), begin * (1.0 + 1e-6)) << "step " << i;
    ASSERT_GT(w.world().audit().smallest_gap_m, 0.0) << "step " << i;
  }
  EXPECT_GT(events, 100);
  EXPECT_GT(energyOf(w.world()), 0.999 * begin) << "and next to none is lost";
}

INSTANTIATE_TEST_SUITE_P(RatesAndSeeds, Trough,
                         testing::Combine(testing::Values(60.0, 240.0), testing::Values(1, 2, 3, 4)));

class SlidingIntoAStop : public testing::TestWithParam<std::tuple<double, double>> {};  // Hz, way in m

// A box slides from rest down a smooth slope for a way s, bounces off a stop at e = 1 and climbs back to
// where it was, over and over: every sqrt(2 s / a) it is at the stop or at the top. The stop is struck within
// a window's ceiling of where it stands, twice in the middle of a step in each period.
TEST_P(SlidingIntoAStop, ComesBackToWhereItBegan) {
  const auto [rate_hz, way_m] = GetParam();
  const double slope = radians(20.0);
  const Quat tilt = oracle::turned(Vec3::UnitY(), slope);
  SmallWorld w(rate_hz, Vec3(0, 0, -kGravity), false);
  const Material smooth = rubbing(0.0, 0.0);
  const Material springy = rubbing(0.0, 1.0);
  w.addPlane(smooth, tilt);
  const Vec3 size(0.5, 0.4, 0.3);
  const double height = 0.5 * size.z() + restGap(size.minCoeff());
  const int box =
      w.add({Solid::box(size), {tilt, tilt * Vec3(0, 0, height)}, Vec3::Zero(), Vec3::Zero(), smooth});
  w.add({Solid::box({1.0, 2.0, 0.2}),
         {tilt, tilt * Vec3(0.25 + way_m + 0.5, 0, 0.15)},
         Vec3::Zero(),
         Vec3::Zero(),
         springy,
         true});
  w.start();
  const double begin = energyOf(w.world());
  const double acceleration = kGravity * std::sin(slope);
  const double fall_J = w.world().mass(box) * acceleration * way_m;
  double farthest = 0.0, bounced_at = 0.0;
  int tops = 0;
  double last_speed = 0.0;
  for (int i = 0; i < static_cast<int>(8.0 * rate_hz); ++i) {
    w.step();
    const double x = (tilt.conjugate() * w.position(box)).x();
    const double speed = (tilt.conjugate() * w.velocity(box)).x();
    farthest = std::max(farthest, x);
    bounced_at += last_speed > 0.0 && speed < 0.0;
    // At the top the parabola of the next fall begins: x + v^2 / 2a is the place where it turned.
    if (last_speed < 0.0 && speed >= 0.0) {
      EXPECT_NEAR(x - 0.5 * speed * speed / acceleration, 0.0, 1e-6) << "top " << tops;
      ++tops;
    }
    ASSERT_NEAR(energyOf(w.world()), begin, 1e-8 * fall_J) << "step " << i;
    last_speed = speed;
  }
  EXPECT_LE(farthest, way_m);
  EXPECT_GE(tops, 3);
  EXPECT_GE(bounced_at, 3);
}

INSTANTIATE_TEST_SUITE_P(RatesAndWays, SlidingIntoAStop,
                         testing::Combine(testing::Values(60.0, 100.0, 240.0), testing::Values(0.7, 1.3)));

}  // namespace
}  // namespace carom::physics
