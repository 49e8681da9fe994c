// What the captions of the scenes beside theory promise (assets/make_theory.py, make_showpieces.py), measured
// in their runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/demos/support/played.h"

namespace carom::demos {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

TEST(LoopTheLoopScene, OnlyTheBeadThatIsFastEnoughStaysOnItsRing) {
  Played played("loop-the-loop");
  const double middle_z = 1.35, start = played.energy();
  double lowest_way[3] = {9, 9, 9};
  const char* const beads[] = {"bead 0.85", "bead 0.97", "bead 1.03"};
  while (played.made.world.time() < 1.3) {
    played.made.world.step();
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = played.place(beads[k]) - Vec3(2.45 * (k - 1), 0.0, middle_z);
      lowest_way[k] = std::min(lowest_way[k], p.norm());
    }
  }
  // On the ring a bead's middle is 0.849 m from the ring's, less its hops from flat to flat.
  EXPECT_LT(lowest_way[0], 0.5);
  EXPECT_LT(lowest_way[1], 0.805);
  EXPECT_GT(lowest_way[2], 0.815);
  EXPECT_NEAR(played.energy() / start, 1.0, 1e-6);
}

TEST(DzhanibekovScene, FlipsWhenEulersEquationsSay) {
  Played played("dzhanibekov");
  const double first = played.scene.caption.variables.at("t1"),
               between = played.scene.caption.variables.at("T");
  std::vector<double> flips;
  double before = 0.0;
  while (played.made.world.time() < played.scene.duration_s) {
    played.made.world.step();
    const double along = (played.state("handle").X_WB.rotation * Vec3::UnitZ()).eval().z();
    // The stem nutates by a few degrees: a flip is where it crosses the level.
    if (before != 0.0 && before * along < 0.0) flips.push_back(played.made.world.time());
    before = along;
  }
  ASSERT_EQ(flips.size(), 4u);
  for (std::size_t k = 0; k < flips.size(); ++k)
    EXPECT_NEAR(flips[k], first + between * static_cast<double>(k), 0.05);
}

TEST(SteadyTopScene, KeepsItsTiltAndGoesRoundAtTheRateOfTheory) {
  Played played("steady-top");
  for (const auto& [name, rate] : {std::pair{"slow top", "W1"}, {"fast top", "W2"}}) {
    const double turning = played.scene.caption.variables.at(rate);
    EXPECT_GT(turning, 0.5);
    Played again("steady-top");
    again.run(2.0);
    const Vec3 axis = again.state(name).X_WB.rotation * Vec3::UnitZ();
    EXPECT_NEAR(std::acos(axis.z()), 25.0 * kDegree, 0.5 * kDegree) << name;
    const double turned = std::atan2(axis.y(), axis.x());
    EXPECT_NEAR(std::remainder(turned - turning * again.made.world.time(), 360.0 * kDegree), 0.0, 0.06)
        << name;
  }
}

TEST(BrachistochroneScene, TheCycloidWinsAndTheTimesAreThoseOfTheory) {
  Played played("brachistochrone");
  const auto& theory = played.scene.caption.variables;
  double arrived[3] = {0, 0, 0};
  const char* const names[] = {"straight", "cycloid", "deep"};
  while (played.made.world.time() < played.scene.duration_s) {
    played.made.world.step();
    for (int k = 0; k < 3; ++k)
      if (arrived[k] == 0.0 && played.place(names[k]).x() >= 0.5 * theory.at("w"))
        arrived[k] = played.made.world.time();
  }
  EXPECT_LT(arrived[1], arrived[2] + 1e-9);
  EXPECT_LT(arrived[2], arrived[0]);
  EXPECT_NEAR(arrived[0], theory.at("t1"), 0.03);
  EXPECT_NEAR(arrived[1], theory.at("t2"), 0.03);
  EXPECT_NEAR(arrived[2], theory.at("t3"), 0.03);
}

TEST(SeesawScene, BalancesByTheLawOfTheLever) {
  Played played("seesaw");
  played.run(played.scene.duration_s);
  const auto tilt = [&](const char* name) {
    return std::acos((played.state(name).X_WB.rotation * Vec3::UnitZ()).eval().z()) / kDegree;
  };
  EXPECT_LT(tilt("even beam"), 0.05);
  EXPECT_GT(tilt("uneven beam"), 15.0);
}

TEST(ArchimedesScene, TheBlocksComeToRestAtTheirDrafts) {
  Played played("archimedes");
  played.run(played.scene.duration_s);
  for (const auto& [name, density] :
       {std::pair{"cork", 0.15}, {"pine", 0.35}, {"oak", 0.55}, {"ash", 0.75}, {"ice", 0.92}})
    EXPECT_NEAR(1.2 - (played.place(name).z() - 0.25), 0.5 * density, 0.012) << name;
}

TEST(DoubleConeScene, RollsTowardsWhereTheRailsAreHigherAndItsAxleSinks) {
  Played played("double-cone");
  played.run(0.3);
  const Vec3 start = played.place("double cone");
  played.run(3.0);
  const Vec3 end = played.place("double cone");
  EXPECT_GT(end.x(), start.x() + 0.8);
  EXPECT_LT(end.z(), start.z() - 0.05);
}

TEST(BilliardScene, StaysItsOwnMirrorImageForSeconds) {
  Played played("billiard-break");
  played.run(2.0);
  const Vec3 a = played.place("ball 11"), b = played.place("ball 15");
  EXPECT_NEAR(a.x(), b.x(), 1e-6);
  EXPECT_NEAR(a.y(), -b.y(), 1e-6);
  EXPECT_GT(std::abs(a.y()), 0.3);
}

TEST(RollerConveyorScene, CratesRideAtTheSpeedOfTheRollers) {
  Played played("roller-conveyor");
  played.run(2.0);
  EXPECT_NEAR(played.state("crate 1").linear_velocity.x(), 8.0 * 0.14, 0.08);
}

TEST(RingTossScene, EveryRingEndsOverThePost) {
  Played played("ring-toss");
  played.run(played.scene.duration_s);
  for (int k = 1; k <= 5; ++k)
    EXPECT_LT(played.place("ring " + std::to_string(k)).head<2>().norm(), 0.5) << k;
}

TEST(MarbleRunScene, EveryMarbleLeavesTheRampsAndTheDominoesFall) {
  Played played("marble-run");
  played.run(played.scene.duration_s);
  for (int k = 0; k < 5; ++k)
    EXPECT_LT(played.place("ramp 1.marble[" + std::to_string(k) + "]").z(), 0.8) << k;
  EXPECT_LT(played.place("domino[0]").z(), 0.3);
}

TEST(IcebergScene, TurnsOver) {
  Played played("iceberg");
  played.run(played.scene.duration_s);
  EXPECT_GT(std::acos((played.state("iceberg").X_WB.rotation * Vec3::UnitZ()).eval().z()) / kDegree, 60.0);
}

}  // namespace
}  // namespace carom::demos
