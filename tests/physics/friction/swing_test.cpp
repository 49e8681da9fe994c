// A plank that rolls to and fro on a lying cylinder is a pendulum: with radius of gyration k about its
// centre, half its thickness s and the cylinder's radius R, its small swings have w^2 = g (R - s) / (k^2 +
// s^2), and nothing takes their energy: after a minute they swing as far as at first, to 0.3 %, at 60 steps a
// second to 1.4 %. (Plainly: contacts of what turns more slowly still are not met in mid-step. A swing whose
// tips go at 8 mm/s gains 3 to 12 % in a minute, one at 3 mm/s 60 to 140 %.) Small ones come to rest in
// resting mode, level; larger ones, and all of them without it, go on; what rolls one way, or is turned round
// by blows, is left alone however slow.

#include <numbers>

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kRadius = 0.3;  // of the cylinder, m
const Vec3 kPlank(1.0, 0.4, 0.04);

class SmallSwing : public testing::TestWithParam<double> {};  // Hz

double closedFormRate() {
  const double s = 0.5 * kPlank.z();
  const double gyration2 = (kPlank.x() * kPlank.x() + kPlank.z() * kPlank.z()) / 12.0;
  return std::sqrt(kGravity * (kRadius - s) / (gyration2 + s * s));
}

// The plank lies level and is given a spin about the cylinder's axis that leaves its point of contact at
// rest.
struct PlankOnCylinder {
  SmallWorld w;
  int plank = -1;

  PlankOnCylinder(double rate_hz, double spin, bool resting_mode)
      : w(rate_hz, Vec3(0.0, 0.0, -kGravity), resting_mode) {
    const Pose lying{oracle::turned(Vec3::UnitX(), 0.5 * std::numbers::pi), Vec3::Zero()};
    w.add({Solid::capsule(kRadius, 1.0), lying, Vec3::Zero(), Vec3::Zero(), rubbing(0.9), true});
    const double s = 0.5 * kPlank.z();
    const Vec3 centre(0.0, 0.0, kRadius + restGap(kPlank.z()) + s);
    plank = w.add({Solid::box(kPlank),
                   {Quat::Identity(), centre},
                   Vec3(spin * s, 0.0, 0.0),
                   Vec3(0.0, spin, 0.0),
                   rubbing(0.9)});
    w.start();
  }
  /// Radians about the cylinder's axis.
  double tilt() const {
    const Vec3 along = w.state(plank).X_WB.rotation * Vec3::UnitX();
    return std::atan2(-along.z(), along.x());
  }
};

// The largest tilt within the next `seconds`.
double amplitude(PlankOnCylinder& p, double seconds) {
  double largest = 0.0;
  for (const double end = p.w.time() + seconds; p.w.time() < end;) {
    p.w.step();
    largest = std::max(largest, std::abs(p.tilt()));
  }
  return largest;
}

TEST_P(SmallSwing, WithoutRestingModeItGoesOnAsAPendulum) {
  const double rate = closedFormRate();
  const double bound = GetParam() < 100.0 ? 0.02 : 5e-3;
  for (double largest_tilt : {0.01, 0.03}) {
    PlankOnCylinder p(GetParam(), largest_tilt * rate, false);
    EXPECT_NEAR(amplitude(p, 2.0) / largest_tilt, 1.0, bound) << largest_tilt;
    p.w.run(56.0);
    EXPECT_NEAR(amplitude(p, 2.0) / largest_tilt, 1.0, bound) << largest_tilt << " after a minute";
  }
}

TEST_P(SmallSwing, SmallOnesComeToRestLevel) {
  for (double largest_tilt : {0.005, 0.02}) {
    PlankOnCylinder p(GetParam(), largest_tilt * closedFormRate(), true);
    EXPECT_NEAR(amplitude(p, 0.7) / largest_tilt, 1.0, 0.02) << "the first half swings are left alone";
    p.w.run(12.0);
    EXPECT_TRUE(p.w.rests(p.plank)) << largest_tilt;
    EXPECT_LT(std::abs(p.tilt()), 1e-4) << largest_tilt;
  }
}

TEST_P(SmallSwing, LargerOnesGoOn) {
  const double largest_tilt = 0.1;
  PlankOnCylinder p(GetParam(), largest_tilt * closedFormRate(), true);
  const double first = amplitude(p, 2.0);
  p.w.run(16.0);
  EXPECT_NEAR(amplitude(p, 2.0) / first, 1.0, 0.02);
}

TEST_P(SmallSwing, ABallThatRollsSlowlyIsLeftAlone) {
  const double angle = 2e-3;
  const Quat tilt = oracle::turned(Vec3::UnitY(), angle);
  const double radius = 0.5;
  SmallWorld w(GetParam());
  w.addPlane(rubbing(0.5), tilt);
  const int ball = w.add({Solid::ball(radius),
                          {tilt, tilt * Vec3(0, 0, radius + restGap(2.0 * radius))},
                          Vec3::Zero(),
                          Vec3::Zero(),
                          rubbing(0.5)});
  w.start();
  w.run(3.0);
  const double speed = 5.0 / 7.0 * kGravity * std::sin(angle) * 3.0;
  EXPECT_NEAR(w.velocity(ball).norm() / speed, 1.0, 1e-3);
}

TEST_P(SmallSwing, ABallBetweenWallsIsTurnedRoundByBlowsAndLeftAlone) {
  const double radius = 0.25, speed = 0.06;
  Material slick = rubbing(0.0, 1.0);
  SmallWorld w(GetParam());
  w.addPlane(slick);
  for (double side : {-1.0, 1.0})
    w.add({Solid::box({1.0, 1.0, 1.0}),
           {Quat::Identity(), Vec3(side * (0.5 + radius + 0.02), 0.0, 0.6)},
           Vec3::Zero(),
           Vec3::Zero(),
           slick,
           true});
  const double height = radius + restGap(2.0 * radius);
  const int ball = w.add({Solid::ball(radius),
                          {Quat::Identity(), Vec3(0.0, 0.0, height)},
                          Vec3(speed, 0.0, 0.0),
                          Vec3::Zero(),
                          slick});
  w.start();
  w.run(8.0);
  EXPECT_NEAR(std::abs(w.velocity(ball).x()) / speed, 1.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Rates, SmallSwing, testing::Values(60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
