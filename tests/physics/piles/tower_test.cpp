// Piles that come to rest, stay at rest, and wake.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

class Tower : public testing::TestWithParam<double> {};

int dropTower(SmallWorld& w, int stories, double drop_m, std::vector<int>& boxes) {
  const int floor = w.addPlane(rubbing(0.5), Quat::Identity(), 10.0);
  for (int i = 0; i < stories; ++i) {
    const Quat turn = oracle::turned(Vec3::UnitZ(), 0.11 * i);
    boxes.push_back(w.add({Solid::box({0.5, 0.5, 0.4}),
                           {turn, Vec3(0.01 * (i % 2), -0.008 * (i % 3), 0.2 + drop_m + i * (0.4 + drop_m))},
                           Vec3::Zero(),
                           Vec3::Zero(),
                           rubbing(0.5)}));
  }
  w.start();
  return floor;
}

TEST_P(Tower, OfFiveComesToRestWithVelocitiesOfExactlyZero) {
  SmallWorld w(GetParam());
  std::vector<int> boxes;
  dropTower(w, 5, 0.02, boxes);
  w.run(5.0);
  for (int b : boxes) {
    EXPECT_TRUE(w.rests(b)) << "box " << b << " " << modeName(w.state(b).mode) << " v "
                            << w.velocity(b).transpose();
    const double height = 0.2 + (b - 1) * 0.4;
    EXPECT_NEAR(w.position(b).z(), height + b * restGap(0.4), 5.0 * restGap(0.4)) << "box " << b;
    EXPECT_LT(w.position(b).head<2>().norm(), 0.03) << "box " << b;
  }
  EXPECT_GT(oracle::smallestGap(w.world()).gap_m, 0.0);
}

TEST_P(Tower, AtRestDoesNotMoveByABit) {
  SmallWorld w(GetParam());
  std::vector<int> boxes;
  dropTower(w, 3, 0.0, boxes);
  w.run(3.0);
  std::vector<Pose> poses;
  for (int b : boxes) {
    ASSERT_TRUE(w.rests(b)) << "box " << b;
    poses.push_back(w.state(b).X_WB);
  }
  w.run(5.0);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(w.position(boxes[i]), poses[i].position);
    EXPECT_EQ(w.state(boxes[i]).X_WB.rotation.coeffs(), poses[i].rotation.coeffs());
  }
}

TEST_P(Tower, AtRestIsWokenByAnImpactAndRestsAgain) {
  SmallWorld w(GetParam());
  w.addPlane(rubbing(0.5), Quat::Identity(), 20.0);
  const Vec3 size(0.5, 0.5, 0.4);
  const int box = w.add(
      {Solid::box(size), lyingBox(size, Quat::Identity(), 0.3), Vec3::Zero(), Vec3::Zero(), rubbing(0.5)});
  const int ball = w.add({Solid::ball(0.1),
                          {Quat::Identity(), Vec3(-12.0, 0.02, 2.55)},
                          Vec3(9.6, 0, 4.0),
                          Vec3::Zero(),
                          rubbing(0.5)});
  w.start();
  w.run(1.0);
  ASSERT_TRUE(w.rests(box));
  const Vec3 before = w.position(box);
  bool woken = false;
  for (int i = 0; i < static_cast<int>(0.6 * GetParam()); ++i) {
    w.step();
    woken = woken || !w.rests(box);
  }
  EXPECT_TRUE(woken) << "ball at " << w.position(ball).transpose();
  w.run(4.0);
  EXPECT_TRUE(w.rests(box));
  EXPECT_GT((w.position(box) - before).norm(), 1e-4);
}

TEST_P(Tower, WakesWhenWhatItLiesOnIsStruckAway) {
  SmallWorld w(GetParam());
  w.addPlane(rubbing(0.1), Quat::Identity(), 20.0);
  const Vec3 size(0.4, 0.4, 0.4);
  const int lower = w.add(
      {Solid::box(size), {Quat::Identity(), Vec3(0, 0, 0.2004)}, Vec3::Zero(), Vec3::Zero(), rubbing(0.1)});
  const int upper = w.add(
      {Solid::box(size), {Quat::Identity(), Vec3(0, 0, 0.6008)}, Vec3::Zero(), Vec3::Zero(), rubbing(0.1)});
  const int hammer = w.add({Solid::box({0.3, 0.3, 0.3}),
                            {Quat::Identity(), Vec3(-15.0, 0, 0.1504)},
                            Vec3(12.0, 0, 0),
                            Vec3::Zero(),
                            {0.1, 0.1, 0.0, 8000.0}});
  w.start();
  w.run(1.0);
  ASSERT_TRUE(w.rests(lower) && w.rests(upper));
  w.run(4.0);
  EXPECT_LT(w.position(hammer).x(), w.position(lower).x());
  EXPECT_GT(w.position(lower).x(), 1.0) << "struck away";
  EXPECT_LT(w.position(upper).z(), 0.5) << "what it lay on has gone";
}

INSTANTIATE_TEST_SUITE_P(Rates, Tower, testing::Values(60.0, 240.0));

}  // namespace
}  // namespace carom::physics
