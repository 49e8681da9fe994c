// Nothing tunnels and nothing overlaps: bullets against a thin wall, a spinning bar, and a rain of random
// hulls.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kWall = 0.02;

// In the wall's frame the bullet came from -x; it has not passed while it is before the wall or beside its
// rim.
bool passedThrough(const SmallWorld& w, int wall, int bullet) {
  const Vec3 p = w.state(wall).X_WB.inverse() * w.position(bullet);
  return p.x() > 0.0 && std::abs(p.y()) < 1.0 && std::abs(p.z()) < 1.0;
}

class Bullet : public testing::TestWithParam<double> {};  // m/s

TEST_P(Bullet, NeverPassesAStaticWall) {
  for (double rate : {60.0, 240.0})
    for (double e : {0.0, 0.7})
      for (const Vec3& spin : {Vec3(0, 0, 0), Vec3(30, -20, 50)}) {
        SmallWorld w(rate, Vec3::Zero());
        const int wall =
            w.add({Solid::box({kWall, 4, 4}), Pose{}, Vec3::Zero(), Vec3::Zero(), rubbing(0.4), true});
        const int bullet = w.add({Solid::box({0.1, 0.1, 0.1}),
                                  {oracle::turned({1, 3, 2}, 0.5), Vec3(-0.7, 0.03, 0.02)},
                                  Vec3(GetParam(), 0.01 * GetParam(), 0),
                                  spin,
                                  rubbing(0.4, e)});
        w.start();
        for (int i = 0; i < std::min(200.0, 2.0 * rate / GetParam() + 10); ++i) {
          w.step();
          ASSERT_FALSE(passedThrough(w, wall, bullet)) << "rate " << rate << " e " << e << " step " << i;
          ASSERT_GT(w.world().audit().smallest_gap_m, 0.0);
        }
        EXPECT_LT(w.velocity(bullet).x(), 0.5 * GetParam()) << "it should have met the wall";
      }
}

TEST_P(Bullet, NeverPassesAWallThatComesTowardsIt) {
  for (double rate : {60.0, 240.0}) {
    SmallWorld w(rate, Vec3::Zero());
    const int wall = w.add({Solid::box({kWall, 4, 4}),
                            {oracle::turned({0, 1, 1}, 0.1), Vec3::Zero()},
                            Vec3(-20, 0, 0),
                            Vec3::Zero(),
                            rubbing(0.4)});
    const int bullet = w.add({Solid::box({0.1, 0.1, 0.1}),
                              {oracle::turned({1, 3, 2}, 0.5), Vec3(-0.7, 0.03, 0.02)},
                              Vec3(GetParam(), 0, 0),
                              Vec3(5, 5, 5),
                              rubbing(0.4, 0.3)});
    w.start();
    const double energy = w.world().audit().kinetic_energy_J;
    for (int i = 0; i < 20; ++i) {
      w.step();
      ASSERT_FALSE(passedThrough(w, wall, bullet)) << "rate " << rate << " step " << i;
      ASSERT_GT(oracle::smallestGap(w.world()).gap_m, 0.0);
      ASSERT_LT(w.world().audit().kinetic_energy_J, energy * (1.0 + 1e-3));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, Bullet, testing::Values(1.0, 10.0, 100.0, 1000.0, 10000.0));

TEST(SpinningBar, NeverSweepsThroughAPost) {
  for (double spin : {3.0, 30.0, 300.0, 3000.0}) {
    SmallWorld w(60.0, Vec3::Zero());
    w.add({Solid::box({0.1, 0.1, 1.0}),
           {Quat::Identity(), Vec3(0.6, 0.05, 0)},
           Vec3::Zero(),
           Vec3::Zero(),
           rubbing(0.2),
           true});
    w.add({Solid::box({2.0, 0.04, 0.04}),
           {oracle::turned(Vec3::UnitZ(), 2.0), Vec3::Zero()},
           Vec3::Zero(),
           Vec3(0, 0, spin),
           rubbing(0.2, 0.5)});
    w.start();
    int events = 0;
    for (int i = 0; i < 60; ++i) {
      w.step();
      events += w.world().audit().last_step.events;
      ASSERT_GT(oracle::smallestGap(w.world()).gap_m, 0.0) << "spin " << spin << " step " << i;
    }
    EXPECT_GT(events, 0) << "spin " << spin;
  }
}

// The invariant of the collision window, seen by an oracle that shares nothing with V-Clip.
TEST(Rain, OfThirtyRandomHullsNeverOverlaps) {
  const std::uint64_t seed = 8;
  oracle::Random random(seed);
  SmallWorld w(120.0);
  w.addPlane(rubbing(0.5, 0.2), Quat::Identity(), 5.0);
  for (int i = 0; i < 30; ++i) {
    const Vec3 place(0.8 * (i % 3 - 1), 0.8 * (i / 3 % 3 - 1), 1.0 + 0.9 * (i / 9));
    w.add({Solid::polyhedron(oracle::randomHull(random, random.integer(6, 20), Vec3(0.35, 0.3, 0.25))),
           {random.rotation(), place + 0.05 * random.direction()},
           random.uniform(0, 3) * random.direction(),
           random.uniform(0, 5) * random.direction(),
           rubbing(random.uniform(0.1, 0.8), random.uniform(0, 0.5))});
  }
  w.start();
  int stopped = 0;
  for (int i = 0; i < 600; ++i) {
    w.step();
    stopped += w.world().audit().last_step.stopped_bodies;
    ASSERT_GT(w.world().audit().smallest_gap_m, 0.0) << "seed " << seed << " step " << i;
    ASSERT_EQ(w.world().audit().last_step.iteration_limits, 0) << "seed " << seed << " step " << i;
    if (i % 20 == 0) {
      const oracle::SmallestGap gap = oracle::smallestGap(w.world());
      ASSERT_GT(gap.gap_m, 0.0) << "seed " << seed << " step " << i << " bodies " << gap.body_a << ' '
                                << gap.body_b;
    }
  }
  RecordProperty("stopped_bodies", stopped);
}

}  // namespace
}  // namespace carom::physics
