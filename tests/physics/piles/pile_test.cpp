// Impulses that pass through many bodies: chains against their closed form, and bins of bodies that must come
// to rest without ever overlapping.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"
#include "tests/support/world_energy.h"

namespace carom::physics {
namespace {

class Chain : public testing::TestWithParam<double> {};

// n boxes stand in a row without friction or gravity, a window apart; one comes at speed v along the row with
// e = 0. Afterwards all n + 1 move together: m v = (n + 1) m v'.
TEST_P(Chain, StruckInelastically_MovesOnAsOneBody) {
  for (double speed : {0.5, 5.0, 50.0}) {
    SCOPED_TRACE(testing::Message() << "rate " << GetParam() << " speed " << speed);
    SmallWorld w(GetParam(), Vec3::Zero());
    constexpr int kStanding = 7;
    std::vector<int> boxes;
    const double pitch = 1.0 + restGap(1.0);
    for (int i = 0; i <= kStanding; ++i) {
      const double x = i == 0 ? -pitch - 0.05 : (i - 1) * pitch;
      const Vec3 velocity(i == 0 ? speed : 0.0, 0.0, 0.0);
      boxes.push_back(w.add({Solid::box(Vec3::Ones()),
                             {Quat::Identity(), Vec3(x, 0, 0)},
                             velocity,
                             Vec3::Zero(),
                             rubbing(0.0)}));
    }
    w.start();
    w.run(1.5 * 0.05 / speed + 3.0 / GetParam());
    double momentum = 0.0;
    for (int b : boxes) {
      momentum += w.velocity(b).x();
      EXPECT_NEAR(w.velocity(b).x(), speed / (kStanding + 1), 0.02 * speed) << "box " << b;
      EXPECT_LT(w.spin(b).norm(), 1e-3 * speed);
    }
    EXPECT_NEAR(momentum, speed, 1e-11 * speed);
    EXPECT_GT(oracle::smallestGap(w.world()).gap_m, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, Chain, testing::Values(60.0, 240.0));

// 28 columns of 20 bricks, each a millimetre over the next, close up: more rows than a step's sweeps can
// bring to rest, so that what pressed in one step is too much in the next. It threw the wall up again by a
// seventh of its energy; what is left are gaps below their band, which are opened again.
TEST(WallOfColumns, ClosesUpWithHardlyAnyEnergyFromNothing) {
  constexpr double kSide = 0.5, kPitch = 0.501;
  SmallWorld w(100.0);
  w.addPlane(rubbing(0.5));
  for (int column = 0; column < 28; ++column)
    for (int k = 0; k < 20; ++k)
      w.add({Solid::box(Vec3::Constant(kSide)),
             {Quat::Identity(), Vec3(0, column * kPitch, 0.5 * kSide + 0.00115 + k * (kSide + 0.00095))},
             Vec3::Zero(),
             Vec3::Zero(),
             rubbing(0.5)});
  w.start();
  double energy = energyOf(w.world()), rises = 0.0, most = 0.0;
  for (int step = 0; step < 30; ++step) {
    w.step();
    const double now = energyOf(w.world());
    rises += std::max(0.0, now - energy);
    energy = now;
    most = std::max(most, w.world().audit().kinetic_energy_J);
  }
  EXPECT_LE(rises, 0.02 * most);
  EXPECT_GT(oracle::smallestGap(w.world()).gap_m, 0.0);
}

// A block of 125 boxes, a window apart and free of gravity, struck on one side by a box of three times their
// density. In a large island impulses need not reach everybody in the step of the blow; but none is lost,
// nothing is gained, few are frozen at their event limit, and soon the far side moves as well.
class StruckBlock : public testing::TestWithParam<double> {
 protected:
  static constexpr int kSide = 5;
  static constexpr double kHeavy = 3.0;

  void place(SmallWorld& w, double speed) {
    const double pitch = 1.0 + restGap(1.0);
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const Vec3 cell(i % kSide, i / kSide % kSide, i / (kSide * kSide));
      boxes_.push_back(w.add({Solid::box(Vec3::Ones()),
                              {Quat::Identity(), pitch * cell},
                              Vec3::Zero(),
                              Vec3::Zero(),
                              rubbing(0.4)}));
    }
    Material heavy = rubbing(0.4);
    heavy.density_kgpm3 *= kHeavy;
    const Quat turned(Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()));
    striker_ = w.add(
        {Solid::box(Vec3::Ones()), {turned, Vec3(-1.5, 1.8, 2.3)}, Vec3(speed, 0, 0), Vec3::Zero(), heavy});
    w.start();
  }
  Vec3 centreOfMass(const SmallWorld& w) const {
    Vec3 sum = kHeavy * w.position(striker_);
    for (const int box : boxes_) sum += w.position(box);
    return sum / (kHeavy + kSide * kSide * kSide);
  }
  double farSpeed(const SmallWorld& w) const {
    double sum = 0.0;
    for (int i = kSide - 1; i < kSide * kSide * kSide; i += kSide)
      sum += w.velocity(boxes_[static_cast<std::size_t>(i)]).x();
    return sum / (kSide * kSide);
  }

  std::vector<int> boxes_;
  int striker_ = -1;
};

TEST_P(StruckBlock, KeepsTheMomentumGainsNoEnergyAndPassesTheBlowOn) {
  constexpr double kRate = 60.0;
  constexpr int kSteps = 60;
  const double speed = GetParam();
  SmallWorld w(kRate, Vec3::Zero());
  place(w, speed);
  const Audit before = w.world().audit();
  double energy = before.kinetic_energy_J;
  const Vec3 centre_before = centreOfMass(w);
  for (int i = 0; i < kSteps; ++i) {
    w.step();
    const Audit now = w.world().audit();
    EXPECT_LE(now.kinetic_energy_J, energy * (1.0 + 1e-9)) << "step " << i;
    energy = now.kinetic_energy_J;
    ASSERT_LT((now.linear_momentum - before.linear_momentum).norm(), 1e-12 * before.linear_momentum.norm());
    ASSERT_GT(oracle::smallestGap(w.world()).gap_m, 0.0) << "step " << i;
  }
  // Impulses leave the centre of mass its velocity. Bodies that are frozen stand still for the rest of their
  // step, and it with them: together that is to cost it less than one step in all.
  const double way = kHeavy * speed / (kHeavy + kSide * kSide * kSide) * kSteps / kRate;
  EXPECT_NEAR((centreOfMass(w) - centre_before).x(), way, way / kSteps);
  EXPECT_GT(farSpeed(w),
            0.5 * kHeavy * speed / (kHeavy + kSide * kSide * kSide));  // half of what all would have
}

INSTANTIATE_TEST_SUITE_P(Speeds, StruckBlock, testing::Values(1.0, 10.0, 60.0));

// Sixty boxes and dodecahedra poured into a box, landing at up to 9 m/s.
class BodiesInABin : public testing::TestWithParam<std::tuple<double, double>> {
 protected:
  static constexpr int kBodies = 60;

  void pour(SmallWorld& w, const Material& material) {
    const auto wall = [&](const Vec3& size, const Vec3& position) {
      w.add({Solid::box(size), {Quat::Identity(), position}, Vec3::Zero(), Vec3::Zero(), material, true});
    };
    w.addPlane(material, Quat::Identity(), 5.0);
    for (double side : {-1.0, 1.0}) {
      wall({1.0, 6.0, 6.0}, {side * 1.75, 0, 3.0});
      wall({6.0, 1.0, 6.0}, {0, side * 1.75, 3.0});
    }
    std::vector<Vec3> points = oracle::dodecahedronPoints();
    const double radius = points.front().norm();
    for (Vec3& p : points) p *= 0.3 / radius;
    const Solid hull = Solid::polyhedron(convexHull(points).polyhedron);
    oracle::Random random(7);
    for (int i = 0; i < kBodies; ++i) {
      const Vec3 position(0.75 * (i % 3 - 1), 0.75 * (i / 3 % 3 - 1), 0.6 + 0.75 * (i / 9));
      const Solid solid = i % 2 == 0 ? Solid::box(Vec3::Constant(0.4)) : hull;
      bodies_.push_back(w.add({solid, {random.rotation(), position}, Vec3::Zero(), Vec3::Zero(), material}));
    }
    w.start();
  }

  std::vector<int> bodies_;
};

TEST_P(BodiesInABin, ComesToRestAndNeverOverlaps) {
  const auto [rate, friction] = GetParam();
  SmallWorld w(rate);
  pour(w, rubbing(friction));
  int stopped = 0;
  int frames = 0;
  for (; frames < static_cast<int>(12.0 * rate) && w.world().audit().resting_bodies < kBodies; ++frames) {
    w.step();
    stopped += w.world().audit().last_step.stopped_bodies;
    if (frames % 40 != 0) continue;
    ASSERT_GT(oracle::smallestGap(w.world()).gap_m, 0.0) << "step " << frames;
  }
  EXPECT_EQ(w.world().audit().resting_bodies, kBodies) << "after " << frames / rate << " s";
  EXPECT_LT(stopped, 1e-3 * kBodies * frames);
}

INSTANTIATE_TEST_SUITE_P(RatesAndFriction, BodiesInABin,
                         testing::Values(std::tuple(60.0, 0.5), std::tuple(240.0, 0.5),
                                         std::tuple(240.0, 0.2)));

}  // namespace
}  // namespace carom::physics
