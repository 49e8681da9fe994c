// Boxes laid on each other at 60 Hz, where every step is worth 16 times a step at 240 Hz: a wall comes to
// rest at once, and a light box carries a heavy one, laid on it or dropped.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kRate = 60.0;

struct Stack {
  SmallWorld w{kRate};
  std::vector<int> stones;
  std::vector<Vec3> begin;

  int stone(const Solid& solid, const Pose& X, const Material& material) {
    stones.push_back(w.add({solid, X, Vec3::Zero(), Vec3::Zero(), material}));
    begin.push_back(X.position);
    return stones.back();
  }
  double movedMost() const {
    double most = 0.0;
    for (std::size_t i = 0; i < stones.size(); ++i)
      most = std::max(most, (w.position(stones[i]) - begin[i]).norm());
    return most;
  }
  int resting() const { return w.world().audit().resting_bodies; }
  int run(double seconds) {
    int stopped = 0;
    for (int i = 0; i < static_cast<int>(seconds * kRate); ++i) {
      w.step();
      stopped += w.world().audit().last_step.stopped_bodies;
    }
    return stopped;
  }
};

// A wall in running bond, twelve courses of eight bricks, or of seven and two halves: it settles by gaps
// alone.
TEST(Wall, ComesToRestWithinASecond) {
  Stack wall;
  const Material clay = rubbing(0.7);
  wall.w.addPlane(clay);
  const Solid brick = Solid::box({0.6, 0.3, 0.25});
  const Solid half = Solid::box({0.299, 0.3, 0.25});
  for (int row = 0; row < 12; ++row) {
    const double z = 0.12515 + 0.2502 * row;
    const bool shifted = row % 2 == 1;
    for (int i = 0; i < (shifted ? 7 : 8); ++i)
      wall.stone(brick, {Quat::Identity(), Vec3(0.602 * i + (shifted ? 0.301 : 0.0), 0, z)}, clay);
    if (!shifted) continue;
    for (double x : {-0.1505, 0.602 * 7 + 0.1505}) wall.stone(half, {Quat::Identity(), Vec3(x, 0, z)}, clay);
  }
  wall.w.start();
  wall.run(1.0);
  EXPECT_EQ(wall.resting(), 12 * 8 + 6);
  EXPECT_LT(wall.movedMost(), 0.005);
}

// A heavy box lies down on a light one, and falls on another, a thousand times lighter.
TEST(HeavyOnLight, NothingIsStoppedOrSqueezedOut) {
  Stack s;
  Material cork = rubbing(0.6), lead = rubbing(0.6);
  cork.density_kgpm3 = 8.0;
  lead.density_kgpm3 = 8000.0;
  s.w.addPlane(cork);
  const Solid cube = Solid::box(Vec3::Constant(0.5));
  const double gap = restGap(0.5);
  for (double x : {-1.0, 1.0}) s.stone(cube, {Quat::Identity(), Vec3(x, 0, 0.25 + gap)}, cork);
  s.stone(cube, {Quat::Identity(), Vec3(-1.0, 0, 0.75 + 2.0 * gap)}, lead);
  const int dropped = s.stone(cube, {Quat::Identity(), Vec3(1.0, 0, 1.75)}, lead);
  s.w.start();
  EXPECT_EQ(s.run(3.0), 0);
  EXPECT_EQ(s.resting(), 4);
  EXPECT_NEAR(s.w.position(dropped).z(), 0.75, 0.005);
}

}  // namespace
}  // namespace carom::physics
