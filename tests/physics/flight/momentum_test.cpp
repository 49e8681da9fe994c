// What a closed system keeps: linear momentum always, energy at e = 1 without friction, and head-on closed
// forms.

#include "tests/oracle/overlap_oracle.h"
#include <array>

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// Random hulls that fly towards the origin and collide there, several at a time.
void addSwarm(SmallWorld& w, std::uint64_t seed, double friction, double restitution) {
  oracle::Random random(seed);
  for (int i = 0; i < 12; ++i) {
    const Vec3 out(std::cos(0.5236 * i), std::sin(0.5236 * i), 0.3 * (i % 3 - 1));
    const Vec3 place = (2.0 + 0.5 * (i % 2)) * out;
    w.add({Solid::polyhedron(oracle::randomHull(random, 12, Vec3(0.4, 0.3, 0.35))),
           {random.rotation(), place},
           -random.uniform(1.0, 4.0) * out,
           random.uniform(0.0, 4.0) * random.direction(),
           {friction, friction, restitution, random.logUniform(100.0, 5000.0)}});
  }
}

double momentumScale(const SmallWorld& w) {
  double sum = 0.0;
  for (std::size_t i = 0; i < w.world().states().size(); ++i)
    sum += w.world().mass(static_cast<int>(i)) * w.world().states()[i].linear_velocity.norm();
  return sum;
}

TEST(ClosedSystem, KeepsItsLinearMomentum) {
  for (std::uint64_t seed : {1u, 2u, 3u})
    for (double restitution : {0.0, 0.6}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " e " << restitution);
      SmallWorld w(120.0, Vec3::Zero());
      addSwarm(w, seed, 0.4, restitution);
      w.start();
      const Vec3 before = w.world().audit().linear_momentum;
      const double scale = momentumScale(w);
      int events = 0, stopped = 0;
      for (int i = 0; i < 360; ++i) {
        w.step();
        events += w.world().audit().last_step.events;
        stopped += w.world().audit().last_step.stopped_bodies;
        ASSERT_GT(w.world().audit().smallest_gap_m, 0.0) << "step " << i;
        ASSERT_LT((w.world().audit().linear_momentum - before).norm(), 1e-12 * scale)
            << "step " << i << ", stopped " << stopped;
      }
      EXPECT_GT(events, 10) << "the bodies should have met";  // momentum holds also where bodies were stopped
    }
}

TEST(ClosedSystem, NeverGainsEnergy) {
  for (std::uint64_t seed : {4u, 5u}) {
    SmallWorld w(120.0, Vec3::Zero());
    addSwarm(w, seed, 0.5, 1.0);
    w.start();
    double energy = w.world().audit().kinetic_energy_J;
    const double begin = energy;
    for (int i = 0; i < 360; ++i) {
      w.step();
      const double now = w.world().audit().kinetic_energy_J;
      // Torque-free rotation keeps its energy within the integrator's second-order error, bounded, not
      // growing.
      ASSERT_LT(now, energy + 1e-4 * begin) << "seed " << seed << " step " << i;
      energy = std::min(energy, now);
    }
  }
}

TEST(ClosedSystem, FrictionlessElasticBalls_KeepTheirEnergyAndAngularMomentum) {
  oracle::Random random(7);
  SmallWorld w(120.0, Vec3::Zero());
  for (int i = 0; i < 10; ++i) {
    const Vec3 out(std::cos(0.63 * i), std::sin(0.63 * i), 0.2 * (i % 3 - 1));
    const double speed = random.uniform(1.0, 4.0);
    const Vec3 aside = 0.1 * random.direction();  // after the speed, whatever the compiler
    w.add({Solid::ball(0.2 + 0.02 * (i % 4)),
           {Quat::Identity(), 2.0 * out},
           aside - speed * out,
           Vec3::Zero(),
           rubbing(0.0, 1.0)});
  }
  w.start();
  const Audit before = w.world().audit();
  int events = 0;
  for (int i = 0; i < 360; ++i) {
    w.step();
    events += w.world().audit().last_step.events;
  }
  const Audit after = w.world().audit();
  EXPECT_GT(events, 8);
  EXPECT_NEAR(after.kinetic_energy_J, before.kinetic_energy_J, 1e-10 * before.kinetic_energy_J);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-10 * momentumScale(w));
}

struct HeadOn {
  double mass_ratio, restitution, rate_hz;
};

// Two boxes, face to face: v' = (m1 v1 + m2 v2 +- m (v2 - v1) e) / (m1 + m2).
TEST(HeadOn, TwoBoxesLeaveWithTheClosedFormVelocities) {
  for (double rate : {60.0, 240.0})
    for (double ratio : {1.0, 3.0, 1000.0})
      for (double e : {0.0, 0.5, 1.0}) {
        SCOPED_TRACE(testing::Message() << "rate " << rate << " ratio " << ratio << " e " << e);
        SmallWorld w(rate, Vec3::Zero());
        const Quat turn = oracle::turned({1, 2, -1}, 0.8);
        const Vec3 axis = turn * Vec3::UnitX();
        const double v1 = 4.0, v2 = -1.5;
        const int a = w.add({Solid::box({0.5, 0.4, 0.3}),
                             {turn, -1.0 * axis},
                             v1 * axis,
                             Vec3::Zero(),
                             {0.4, 0.4, e, 1000.0}});
        const int b = w.add({Solid::box({0.5, 0.4, 0.3}),
                             {turn, 1.0 * axis},
                             v2 * axis,
                             Vec3::Zero(),
                             {0.4, 0.4, e, 1000.0 * ratio}});
        w.start();
        w.run(0.5);
        const double common = (v1 + ratio * v2) / (1.0 + ratio);
        const double want_a = common + e * ratio * (v2 - v1) / (1.0 + ratio);
        const double want_b = common + e * (v1 - v2) / (1.0 + ratio);
        EXPECT_LT((w.velocity(a) - want_a * axis).norm(), 1e-9);
        EXPECT_LT((w.velocity(b) - want_b * axis).norm(), 1e-9);
        EXPECT_LT(w.spin(a).norm() + w.spin(b).norm(), 1e-8);
      }
}

// Balls one rest gap apart in a row: the gap makes the blow a chain of binary impacts, and the last one flies
// off.
TEST(NewtonsCradle, PassesTheBlowOnToTheLastBall) {
  SmallWorld w(240.0, Vec3::Zero());
  std::vector<int> balls;
  const double d = 0.2 + restGap(0.2);
  balls.push_back(w.add({Solid::ball(0.1),
                         {Quat::Identity(), Vec3(-1.0, 0, 0)},
                         Vec3(2, 0, 0),
                         Vec3::Zero(),
                         rubbing(0.3, 1.0)}));
  for (int i = 0; i < 4; ++i)
    balls.push_back(w.add({Solid::ball(0.1),
                           {Quat::Identity(), Vec3(i * d, 0, 0)},
                           Vec3::Zero(),
                           Vec3::Zero(),
                           rubbing(0.3, 1.0)}));
  w.start();
  w.run(1.0);
  for (int i = 0; i < 4; ++i) EXPECT_LT(w.velocity(balls[static_cast<std::size_t>(i)]).norm(), 1e-9) << i;
  EXPECT_LT((w.velocity(balls[4]) - Vec3(2, 0, 0)).norm(), 1e-9);
}

// A ball runs into two that lie side by side, at e = 1 without friction. By symmetry, momentum and energy: it
// comes back with v / 5, and they leave along the lines of centres, 30 degrees to either side, with
// 2 sqrt(3) / 5 v. Whoever comes first in the list.
class Billiards : public testing::TestWithParam<std::array<int, 3>> {};

TEST_P(Billiards, ABallBetweenTwo_IsOneCollision) {
  const double d = 0.2 + restGap(0.2), angle = 0.7;
  const Quat heading = oracle::turned(Vec3::UnitZ(), angle);
  const std::array<Vec3, 3> places{Vec3(-1.0, 0, 0), Vec3(0, 0.5 * d, 0), Vec3(0, -0.5 * d, 0)};
  SmallWorld w(240.0, Vec3::Zero());
  std::array<int, 3> ids{};
  for (const int k : GetParam())
    ids[static_cast<std::size_t>(k)] =
        w.add({Solid::ball(0.1),
               {Quat::Identity(), heading * places[static_cast<std::size_t>(k)]},
               k == 0 ? Vec3(heading * Vec3(2, 0, 0)) : Vec3(Vec3::Zero()),
               Vec3::Zero(),
               rubbing(0.0, 1.0)});
  w.start();
  w.run(1.0);
  const auto seen = [&](int k) {
    return Vec3(heading.conjugate() * w.velocity(ids[static_cast<std::size_t>(k)]));
  };
  // The lines of centres stand 30 degrees to the heading but for the gap at which balls meet, 1.5 mm of 0.2
  // m.
  EXPECT_LT((seen(0) - Vec3(-0.4, 0, 0)).norm(), 5e-3);
  EXPECT_NEAR(seen(1).norm(), 0.8 * std::sqrt(3.0), 5e-3);
  EXPECT_NEAR(seen(0).y(), 0.0, 1e-12);
  EXPECT_NEAR(seen(1).x(), seen(2).x(), 1e-12);
  EXPECT_NEAR(seen(1).y(), -seen(2).y(), 1e-12);
  EXPECT_NEAR(seen(0).squaredNorm() + seen(1).squaredNorm() + seen(2).squaredNorm(), 4.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Orders, Billiards,
                         testing::Values(std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 0, 2},
                                         std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{2, 1, 0}));

}  // namespace
}  // namespace carom::physics
