// What moves fast or differs much in size: boxes head-on to 10 km/s against their closed form, bullets
// through a pile, and a thousand to one in size.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class HeadOnSpeed : public testing::TestWithParam<std::tuple<double, double>> {};  // m/s, Hz

// Equal masses face to face: the velocities are exchanged at e = 1, and become (1 -+ e) / 2 of them
// otherwise.
TEST_P(HeadOnSpeed, TwoBoxesNeverChangeSides) {
  const auto [speed, rate] = GetParam();
  for (double e : {0.0, 0.5, 1.0}) {
    SCOPED_TRACE(testing::Message() << "e " << e);
    SmallWorld w(rate, Vec3::Zero());
    const Quat turn = oracle::turned({1, 2, -1}, 0.8);
    const Vec3 axis = turn * Vec3::UnitX();
    const auto box = [&](double x, double v) {
      return w.add(
          {Solid::box(Vec3::Constant(0.1)), {turn, x * axis}, v * axis, Vec3::Zero(), rubbing(0.4, e)});
    };
    const int a = box(-0.31, speed), b = box(0.4, -0.7 * speed);
    w.start();
    const int steps = static_cast<int>(rate / speed) + 4;
    for (int i = 0; i < steps; ++i) {
      w.step();
      ASSERT_GT(axis.dot(w.position(b) - w.position(a)), 0.1) << "step " << i;
      ASSERT_GT(oracle::smallestGap(w.world()).gap_m, 0.0) << "step " << i;
    }
    const double va = 0.5 * (1.0 - 0.7) * speed - 0.5 * e * 1.7 * speed;
    const double vb = 0.5 * (1.0 - 0.7) * speed + 0.5 * e * 1.7 * speed;
    EXPECT_LT((w.velocity(a) - va * axis).norm(), 1e-9 * speed);
    EXPECT_LT((w.velocity(b) - vb * axis).norm(), 1e-9 * speed);
  }
}

INSTANTIATE_TEST_SUITE_P(SpeedsAndRates, HeadOnSpeed,
                         testing::Combine(testing::Values(1.0, 10.0, 100.0, 1000.0, 10000.0),
                                          testing::Values(30.0, 60.0, 240.0)));

class PileUnderFire : public testing::TestWithParam<double> {};  // m/s

// Twenty-seven boxes at rest, five bullets from different sides. Friction and e = 0.3 only take energy.
TEST_P(PileUnderFire, NothingOverlapsAndNoEnergyIsFound) {
  SmallWorld w(60.0);
  w.addPlane(rubbing(0.5, 0.3), Quat::Identity(), 200.0);
  const double pitch = 0.5 + restGap(0.5);
  for (int i = 0; i < 27; ++i) {
    const Vec3 place((i % 3 - 1) * 0.52, (i / 3 % 3 - 1) * 0.52, 0.25 + restGap(0.5) + (i / 9) * pitch);
    w.add({Solid::box(Vec3::Constant(0.5)),
           {Quat::Identity(), place},
           Vec3::Zero(),
           Vec3::Zero(),
           rubbing(0.5, 0.3)});
  }
  oracle::Random random(3);
  for (int i = 0; i < 5; ++i) {
    const Vec3 from(3.0 * std::cos(1.3 * i), 3.0 * std::sin(1.3 * i), 0.4 + 0.2 * i);
    const Vec3 aim = (Vec3(0.1 * i, 0.05, 0.7) - from).normalized();
    w.add({Solid::box(Vec3::Constant(0.1)),
           {random.rotation(), from},
           GetParam() * aim,
           20.0 * random.direction(),
           rubbing(0.5, 0.3)});
  }
  w.start();
  const auto energy = [&w] {
    const Audit now = w.world().audit();
    return now.kinetic_energy_J + now.potential_energy_J;
  };
  const double begin = energy();
  for (int i = 0; i < 60; ++i) {
    w.step();
    ASSERT_GT(w.world().audit().smallest_gap_m, 0.0) << "step " << i;
    // Carried bodies take gravity once a step: half of g dt a step on each may come and go.
    ASSERT_LT(energy(), begin * (1.0 + 1e-3) + 100.0) << "step " << i;
    if (i % 4 != 0) continue;
    const oracle::SmallestGap gap = oracle::smallestGap(w.world());
    ASSERT_GT(gap.gap_m, 0.0) << "step " << i << " bodies " << gap.body_a << ' ' << gap.body_b;
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, PileUnderFire, testing::Values(30.0, 300.0, 3000.0));

// A metre above millimetres: three grains on the ground carry a cube that is 10^9 times as heavy, and grains
// fall on it.
class SizeRatioOfAThousand : public testing::TestWithParam<double> {
 protected:
  static constexpr double kGrain = 1e-3;

  SizeRatioOfAThousand() : w_(GetParam()) {
    w_.addPlane(rubbing(0.5));
    for (int i = 0; i < 3; ++i) {
      const Vec3 place(0.3 * std::cos(2.1 * i), 0.3 * std::sin(2.1 * i), 0.5 * kGrain + restGap(kGrain));
      addGrain({Quat::Identity(), place});
    }
    cube_ = w_.add({Solid::box(Vec3::Ones()),
                    {Quat::Identity(), Vec3(0, 0, 0.5 + kGrain + 0.01)},
                    Vec3::Zero(),
                    Vec3::Zero(),
                    rubbing(0.5)});
    for (int i = 0; i < 4; ++i)
      addGrain({oracle::turned({1, 1, 3}, 0.4 + i), Vec3(0.1 * i, 0.05, 1.1 + 0.05 * i)});
    w_.start();
  }
  void addGrain(const Pose& X) {
    grains_.push_back(
        w_.add({Solid::box(Vec3::Constant(kGrain)), X, Vec3::Zero(), Vec3::Zero(), rubbing(0.5)}));
  }

  SmallWorld w_;
  std::vector<int> grains_;
  int cube_ = -1;
};

TEST_P(SizeRatioOfAThousand, NeverOverlapsAndTheGrainsCarry) {
  for (int i = 0; i < static_cast<int>(2.0 * GetParam()); ++i) {
    w_.step();
    ASSERT_GT(w_.world().audit().smallest_gap_m, 0.0) << "step " << i;
    ASSERT_GT(w_.position(cube_).z(), 0.5 + kGrain) << "step " << i;
    if (i % 8 == 0) {
      ASSERT_GT(oracle::smallestGap(w_.world()).gap_m, 0.0) << "step " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, SizeRatioOfAThousand, testing::Values(60.0, 240.0));

// Air that stands still only takes energy, however few of its strokes a turn gets, and when an impact falls
// within the step: found by the explorer as a needle at 10 km/s that turned by 16 radians a step and left
// with twice its energy.
class SlenderInAir : public testing::TestWithParam<bool> {};  // meets a floor

TEST_P(SlenderInAir, GainsNoEnergyWhenItTurnsByRadiansAStep) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    oracle::Random random(seed);
    WorldSettings settings{1.0 / 500.0, Vec3::Zero()};
    settings.air.density_kgpm3 = 1.2;
    SmallWorld w(settings);
    if (GetParam()) w.addPlane(rubbing(0.0), Quat::Identity(), 200.0);
    Vec3 size = Vec3::Constant(5.0);
    for (int axis = 1; axis < 3; ++axis) size[axis] = random.uniform(0.02, 0.1);
    Vec3 velocity = 1e4 * random.direction();
    velocity.z() = -std::abs(velocity.z());
    const Vec3 spin = 1e4 * random.direction();
    const Quat turn = random.rotation();
    w.add({Solid::box(size), {turn, {0, 0, 20}}, velocity, spin, rubbing(0.0)});
    w.start();
    double energy = w.world().audit().kinetic_energy_J;
    for (int i = 0; i < 30; ++i) {
      w.step();
      const double now = w.world().audit().kinetic_energy_J;
      ASSERT_LE(now, energy * (1.0 + 1e-9)) << "step " << i;
      energy = now;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Floor, SlenderInAir, testing::Bool());

}  // namespace
}  // namespace carom::physics
