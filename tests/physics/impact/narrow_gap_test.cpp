// Gaps hardly wider than what moves in them (paper §2.3, fig. 6 and 7): a ball that rattles between two
// faces, walls that close on a ball, and bodies that begin inside the collision window or below its floor.

#include "tests/oracle/overlap_oracle.h"
#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kRadius = 0.1;

// Two static faces `slack` farther apart than the ball is wide.
int addBallBetweenFaces(SmallWorld& w, double slack, double speed) {
  for (double side : {-1.0, 1.0}) {
    const Vec3 place(side * (1.0 + kRadius + 0.5 * slack), 0, 0);
    w.add({Solid::box({2, 4, 4}),
           {Quat::Identity(), place},
           Vec3::Zero(),
           Vec3::Zero(),
           rubbing(0.0, 1.0),
           true});
  }
  return w.add({Solid::ball(kRadius), Pose{}, Vec3(speed, 0, 0), Vec3::Zero(), rubbing(0.0, 1.0)});
}

struct Rattle {
  double slack_m, speed_mps, rate_hz;
};
class RattlingBall : public testing::TestWithParam<Rattle> {};

// Each crossing is as long as the slack less the gaps at which the ball is struck, which lie in the window:
// in a time T there are between v T / (slack - 2 floor) and v T / (slack - 2 ceiling) blows, but for one.
TEST_P(RattlingBall, IsStruckAsOftenAsTheClosedFormAndKeepsItsSpeed) {
  const Rattle& r = GetParam();
  SmallWorld w(r.rate_hz, Vec3::Zero());
  const int ball = addBallBetweenFaces(w, r.slack_m, r.speed_mps);
  w.start();
  const double floor = tolerance::kWindowFloor * 2.0 * kRadius;
  constexpr double kSeconds = 2.0;
  long blows = 0, held = 0;
  for (int i = 0; i < static_cast<int>(kSeconds * r.rate_hz); ++i) {
    w.step();
    blows += w.world().audit().last_step.events;
    held += w.world().audit().last_step.stopped_bodies;
    ASSERT_GE(0.5 * r.slack_m - std::abs(w.position(ball).x()), floor * (1.0 - 1e-6)) << "step " << i;
    ASSERT_NEAR(w.velocity(ball).norm(), r.speed_mps, 1e-9 * r.speed_mps) << "step " << i;
  }
  EXPECT_EQ(held, 0);
  const double path = r.speed_mps * kSeconds;
  EXPECT_GE(static_cast<double>(blows), path / (r.slack_m - 2.0 * floor) - 1.0);
  EXPECT_LE(static_cast<double>(blows), path / (r.slack_m - 2.0 * windowCeiling(2.0 * kRadius)) + 1.0);
}

// From a blow every few steps to twenty in one.
INSTANTIATE_TEST_SUITE_P(Slacks, RattlingBall,
                         testing::Values(Rattle{0.05, 1.0, 60}, Rattle{0.005, 1.0, 60},
                                         Rattle{0.005, 1.0, 240}, Rattle{0.01, 5.0, 30},
                                         Rattle{0.002, 0.5, 60}, Rattle{0.1, 100.0, 60}));

// More blows in a step than its budget: time may be lost, the faces are not passed and no energy is found.
TEST(RattlingBall, BeyondTheEventBudget_StaysBetweenTheFaces) {
  for (double speed : {10.0, 1e3, 1e4})
    for (double slack : {0.0006, 0.005, 0.05}) {
      SCOPED_TRACE(testing::Message() << "speed " << speed << " slack " << slack);
      SmallWorld w(60.0, Vec3::Zero());
      const int ball = addBallBetweenFaces(w, slack, speed);
      w.start();
      for (int i = 0; i < 120; ++i) {
        w.step();
        ASSERT_LT(std::abs(w.position(ball).x()), 0.5 * slack) << "step " << i;
        ASSERT_LE(w.velocity(ball).norm(), speed * (1.0 + 1e-9)) << "step " << i;
      }
      EXPECT_GT(oracle::smallestGap(w.world()).gap_m, 0.0);
    }
}

struct ClosingWalls {
  SmallWorld w;
  int left = -1, right = -1, ball = -1;

  ClosingWalls(double rate_hz, double restitution, double ball_speed, double apart_m = 1.0)
      : w(rate_hz, Vec3::Zero()) {
    const Material heavy{0.0, 0.0, restitution, 1e4};
    const auto wall = [&](double side) {
      return w.add({Solid::box({0.5, 2, 2}),
                    {Quat::Identity(), Vec3(side * (0.25 + 0.5 * apart_m), 0, 0)},
                    Vec3(-side, 0, 0),
                    Vec3::Zero(),
                    heavy});
    };
    left = wall(-1.0);
    right = wall(1.0);
    ball = w.add({Solid::ball(kRadius),
                  Pose{},
                  Vec3(ball_speed, 0, 0),
                  Vec3::Zero(),
                  {0.0, 0.0, restitution, 1000.0}});
    w.start();
  }
  bool ballIsBetween() const {
    return w.position(left).x() + 0.25 < w.position(ball).x() - kRadius &&
           w.position(ball).x() + kRadius < w.position(right).x() - 0.25;
  }
};

class ShrinkingGap : public testing::TestWithParam<double> {};

// e = 0: the sandwich's momentum is the ball's alone, and all three end with one velocity.
TEST_P(ShrinkingGap, ClosedInelastically_EndsAsOneBody) {
  ClosingWalls s(GetParam(), 0.0, 3.0);
  const Vec3 momentum = s.w.world().audit().linear_momentum;
  for (int i = 0; i < static_cast<int>(2.0 * GetParam()); ++i) {
    s.w.step();
    ASSERT_TRUE(s.ballIsBetween()) << "step " << i;
    ASSERT_GT(oracle::smallestGap(s.w.world()).gap_m, 0.0) << "step " << i;
  }
  const double mass = s.w.world().mass(s.ball) + 2.0 * s.w.world().mass(s.left);
  for (int body : {s.left, s.right, s.ball})
    EXPECT_NEAR(s.w.velocity(body).x(), momentum.x() / mass, 1e-3) << "body " << body;
  EXPECT_NEAR(s.w.world().audit().linear_momentum.x(), momentum.x(), 1e-9);
}

// e = 1: the ball takes all the walls' energy, whatever its own, and gives it back: they part as fast as they
// came. Speed times free width is an adiabatic invariant, so the walls come nearest at about L0 v0 / v_max.
TEST_P(ShrinkingGap, ClosedElastically_KeepsTheEnergyAndOpensAgain) {
  for (double speed : {3.0, 30.0}) {
    SCOPED_TRACE(testing::Message() << "ball " << speed << " m/s");
    ClosingWalls s(GetParam(), 1.0, speed);
    const double energy = s.w.world().audit().kinetic_energy_J;
    for (int i = 0; i < static_cast<int>(2.0 * GetParam()); ++i) {
      s.w.step();
      ASSERT_TRUE(s.ballIsBetween()) << "step " << i;
      ASSERT_GT(s.w.world().audit().smallest_gap_m, 0.0) << "step " << i;
      ASSERT_NEAR(s.w.world().audit().kinetic_energy_J, energy, 1e-9 * energy) << "step " << i;
    }
    EXPECT_LT(s.w.velocity(s.left).x(), -0.5) << "the walls should have been driven apart";
    EXPECT_GT(s.w.velocity(s.right).x(), 0.5) << "the walls should have been driven apart";
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, ShrinkingGap, testing::Values(30.0, 60.0, 240.0));

// A hit at fraction 0 is a hit: x(dt) = x0 + v dt after an elastic blow at the step's very beginning.
TEST(InsideTheWindow, AFastApproach_IsStruckAtOnce) {
  const Quat tilt = oracle::turned({1, 2, 0.5}, 0.7);
  const Vec3 up = tilt * Vec3::UnitZ();
  for (double share : {0.15, 0.5, 0.9})  // of the ceiling
    for (double speed : {1.0, 30.0, 1e4}) {
      SCOPED_TRACE(testing::Message() << "share " << share << " speed " << speed);
      SmallWorld w(60.0, Vec3::Zero());
      w.addPlane(rubbing(0.0, 1.0), tilt);
      const double height = 0.5 + share * windowCeiling(1.0);
      const int box = w.add(
          {Solid::box(Vec3::Ones()), {tilt, height * up}, -speed * up, Vec3::Zero(), rubbing(0.0, 1.0)});
      w.start();
      const Vec3 begin = w.position(box);  // from less than the rest gap it is moved there
      w.step();
      EXPECT_LT((w.velocity(box) - speed * up).norm(), 1e-9 * speed);
      EXPECT_LT((w.position(box) - (begin + speed / 60.0 * up)).norm(), 1e-9 * (1.0 + speed));
    }
}

// Nothing forbids a start below the floor; from there a body may leave, and may not come nearer.
TEST(BelowTheFloor, ABodyIsNeverLetNearer) {
  const double floor = tolerance::kWindowFloor;
  for (double gap : {0.0, 0.01 * floor, 0.5 * floor})
    for (double speed : {-1e4, -5.0, -0.01, 0.0, 0.01, 5.0}) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << " speed " << speed);
      SmallWorld w(60.0, Vec3::Zero());
      w.addPlane(rubbing(0.3, 0.5));
      const int box = w.add({Solid::box(Vec3::Ones()),
                             {oracle::turned(Vec3::UnitZ(), 0.4), Vec3(0, 0, 0.5 + gap)},
                             Vec3(0, 0, speed),
                             Vec3::Zero(),
                             rubbing(0.3, 0.5)});
      w.start();
      for (int i = 0; i < 30; ++i) {
        w.step();
        ASSERT_GE(w.position(box).z() - 0.5, std::max(gap, 0.9 * floor) * (1.0 - 1e-9)) << "step " << i;
      }
      if (speed > 0.0) {
        EXPECT_NEAR(w.velocity(box).z(), speed, 1e-9);
      }
      if (speed < -1.0) {
        EXPECT_NEAR(w.velocity(box).z(), -0.5 * speed, 1e-9 * std::abs(speed));
      }
    }
}

TEST(Overlapping, BodiesAreRefusedByNameWithTheirDepth) {
  World world{WorldSettings{}};
  const int cube = world.addSolid(Solid::box(Vec3::Ones()));
  for (double x : {0.0, 3.0, 3.9, 8.0})
    world.addBody({cube, {Quat::Identity(), Vec3(x, 0, 0)}, Vec3::Zero(), Vec3::Zero(), {}, false});
  const std::vector<Overlap> overlaps = world.start();
  ASSERT_EQ(overlaps.size(), 1u);
  EXPECT_EQ(overlaps[0].body_a, 1);
  EXPECT_EQ(overlaps[0].body_b, 2);
  EXPECT_NEAR(overlaps[0].depth_m, 0.1, 1e-12);
}

}  // namespace
}  // namespace carom::physics
