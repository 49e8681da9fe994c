// Coulomb friction on a level floor: a block thrown along it stops after v^2 / 2 mu g, whichever way it is
// headed.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

constexpr double kAllowed = 1e-3;  // the bar: 0.1 %

struct Slide {
  double rate_hz = 240.0;
  double friction = 0.5;
  double heading_deg = 0.0;  ///< Of the throw.
  double turn_deg = 0.0;     ///< Of the block about the vertical.
  double speed_mps = 3.0;
};

struct Stop {
  Vec3 path = Vec3::Zero();
  double seconds = 0.0;
  double turned = 0.0;  ///< Angle by which the block turned on the way, radians.
  bool rests = false;
};

Stop slideToAStop(const Slide& s) {
  SmallWorld w(s.rate_hz);
  w.addPlane(rubbing(s.friction));
  const Vec3 size(0.6, 0.5, 0.2);
  const Pose X = lyingBox(size, Quat::Identity(), radians(s.turn_deg));
  const Vec3 heading(std::cos(radians(s.heading_deg)), std::sin(radians(s.heading_deg)), 0.0);
  const int block = w.add({Solid::box(size), X, s.speed_mps * heading, Vec3::Zero(), rubbing(s.friction)});
  w.start();
  Stop stop;
  while (w.time() < 10.0 && !w.rests(block)) {
    w.step();
    if (stop.seconds == 0.0 && w.velocity(block).norm() < 1e-6) stop.seconds = w.time();
  }
  stop.path = w.position(block) - X.position;
  stop.turned = w.state(block).X_WB.rotation.angularDistance(X.rotation);
  stop.rests = w.rests(block);
  return stop;
}

void expectCoulombStop(const Slide& s, double allowed) {
  const Stop stop = slideToAStop(s);
  const double expected = s.speed_mps * s.speed_mps / (2.0 * s.friction * kGravity);
  const Vec3 heading(std::cos(radians(s.heading_deg)), std::sin(radians(s.heading_deg)), 0.0);
  const Vec3 aside = stop.path - stop.path.dot(heading) * heading;
  SCOPED_TRACE(testing::Message() << "rate " << s.rate_hz << " mu " << s.friction << " heading "
                                  << s.heading_deg << " turn " << s.turn_deg);
  EXPECT_TRUE(stop.rests);
  EXPECT_NEAR(stop.path.dot(heading) / expected, 1.0, allowed);
  EXPECT_LT(aside.norm(), allowed * expected);
  EXPECT_LT(stop.turned, 1e-3);
  EXPECT_NEAR(stop.seconds, s.speed_mps / (s.friction * kGravity), 2.0 / s.rate_hz);
}

TEST(SlidingBlock, StopsAtTheCoulombDistance_AtEveryHeading) {
  for (double friction : {0.2, 0.5, 0.8})
    for (double heading : {0.0, 30.0, 45.0, 77.0})
      expectCoulombStop({240.0, friction, heading, 0.0, 3.0}, kAllowed);
}

TEST(SlidingBlock, StopsAtTheCoulombDistance_WhicheverWayItIsTurned) {
  for (double turn : {10.0, 45.0, 63.0}) expectCoulombStop({240.0, 0.5, 20.0, turn, 3.0}, kAllowed);
}

TEST(SlidingBlock, StopsAtTheCoulombDistance_FromSlowAndFastThrows) {
  for (double speed : {1.0, 7.0}) expectCoulombStop({240.0, 0.5, 30.0, 0.0, speed}, kAllowed);
}

TEST(SlidingBlock, StopsAtTheCoulombDistance_AtCoarserSteps) {
  for (double rate : {60.0, 120.0})
    for (double friction : {0.2, 0.5, 0.8}) expectCoulombStop({rate, friction, 30.0, 0.0, 3.0}, kAllowed);
}

// The geometric mean of two coefficients acts; the dynamic one brakes a block that slides.
TEST(SlidingBlock, IsBrakedByTheMeanOfTheDynamicCoefficients) {
  SmallWorld w;
  w.addPlane({1.2, 0.9, 0.0, 1000.0});
  const Vec3 size(0.6, 0.5, 0.2);
  const int block = w.add({Solid::box(size),
                           lyingBox(size, Quat::Identity(), 0.4),
                           Vec3(3, 0, 0),
                           Vec3::Zero(),
                           {0.8, 0.1, 0.0, 1000.0}});
  w.start();
  w.run(0.5);
  EXPECT_NEAR(w.velocity(block).x(), 3.0 - 0.3 * kGravity * 0.5, 1e-4 * 3.0);
  EXPECT_EQ(w.state(block).mode, Mode::kSliding);
}

TEST(SlidingBlock, WithoutFrictionKeepsItsSpeed) {
  SmallWorld w;
  w.addPlane(rubbing(0.0));
  const Vec3 size(0.6, 0.5, 0.2);
  const int block = w.add(
      {Solid::box(size), lyingBox(size, Quat::Identity(), 0.4), Vec3(2, 1, 0), Vec3::Zero(), rubbing(0.0)});
  w.start();
  w.run(5.0);
  EXPECT_LT((w.velocity(block) - Vec3(2, 1, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace carom::physics
