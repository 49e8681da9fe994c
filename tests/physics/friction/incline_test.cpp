// Down an incline: a sliding block's g (sin - mu cos), a rolling ball's 5/7 g sin, and a ball that slips.

#include "tests/physics/small_world.h"

namespace carom::physics {
namespace {

// The plane falls off along x after it was turned by `heading` about the vertical.
Quat inclineTilt(double angle, double heading) {
  return oracle::turned(Vec3::UnitZ(), heading) * oracle::turned(Vec3::UnitY(), angle);
}

struct Descent {
  double acceleration_mps2 = 0.0;  ///< Down the slope.
  double aside_mps2 = 0.0;
  Vec3 spin_rate = Vec3::Zero();  ///< Incline frame.
  double turned = 0.0;
};

struct OnIncline {
  Solid solid;
  double height_m = 0.0;  ///< Of its centre over the plane.
  Quat turn = Quat::Identity();
};

Descent downTheIncline(const OnIncline& body_there, const Quat& tilt, double friction, double rate,
                       double seconds) {
  const auto& [solid, height, turn] = body_there;
  SmallWorld w(rate);
  w.addPlane(rubbing(friction), tilt);
  const Pose X{tilt * turn, tilt * Vec3(-3.0, 0.5, height)};
  const int body = w.add({solid, X, Vec3::Zero(), Vec3::Zero(), rubbing(friction)});
  w.start();
  w.run(seconds);
  const Vec3 v = tilt.conjugate() * w.velocity(body);
  return {v.x() / seconds, std::hypot(v.y(), v.z()) / seconds, tilt.conjugate() * w.spin(body) / seconds,
          w.state(body).X_WB.rotation.angularDistance(X.rotation)};
}

class Incline : public testing::TestWithParam<double> {};

TEST_P(Incline, SlidingBlockAcceleratesByGTimesSineLessFriction) {
  const Vec3 size(0.6, 0.5, 0.2);
  for (double friction : {0.0, 0.2, 0.45})
    for (double heading : {0.0, 0.9})
      for (double turn : {0.0, 0.6}) {
        const double angle = radians(30.0);
        const double expected = kGravity * (std::sin(angle) - friction * std::cos(angle));
        const Descent run =
            downTheIncline({Solid::box(size), 0.1 + restGap(0.2), oracle::turned(Vec3::UnitZ(), turn)},
                           inclineTilt(angle, heading), friction, GetParam(), 1.0);
        SCOPED_TRACE(testing::Message() << "mu " << friction << " heading " << heading << " turn " << turn);
        EXPECT_NEAR(run.acceleration_mps2 / expected, 1.0, 1e-4);
        EXPECT_LT(run.aside_mps2, 1e-4 * expected);
        EXPECT_LT(run.turned, 1e-3);
      }
}

TEST_P(Incline, RollingBallAcceleratesByFiveSeventhsOfGTimesSine) {
  for (double angle_deg : {10.0, 30.0}) {
    const double angle = radians(angle_deg), radius = 0.25;
    const double expected = 5.0 / 7.0 * kGravity * std::sin(angle);
    for (double friction : {1.02 * 2.0 / 7.0 * std::tan(angle), 0.8}) {
      const Descent run =
          downTheIncline({Solid::ball(radius), radius + restGap(0.5), oracle::turned({1, 2, 3}, 1.0)},
                         inclineTilt(angle, 0.7), friction, GetParam(), 1.0);
      SCOPED_TRACE(testing::Message() << "angle " << angle_deg << " mu " << friction);
      // The contact point lies half a gap below the ball: r + g/2 takes the place of r in the lever, 0.5 gap
      // / r of it.
      const double lever = restGap(0.5) / radius;
      EXPECT_NEAR(run.acceleration_mps2 / expected, 1.0, 1e-4 + lever);
      EXPECT_NEAR(run.spin_rate.y() * radius / expected, 1.0, 1e-4 + lever);
      EXPECT_LT(run.aside_mps2, 1e-4 * expected);
    }
  }
}

TEST_P(Incline, SlippingBallAcceleratesLikeABlockAndSpinsByFriction) {
  const double angle = radians(40.0), radius = 0.25, friction = 0.1;
  const Descent run = downTheIncline({Solid::ball(radius), radius + restGap(0.5)}, inclineTilt(angle, 0.3),
                                     friction, GetParam(), 1.0);
  EXPECT_NEAR(run.acceleration_mps2 / (kGravity * (std::sin(angle) - friction * std::cos(angle))), 1.0, 1e-4);
  const double spin_rate = 2.5 * friction * kGravity * std::cos(angle) / radius;
  EXPECT_NEAR(run.spin_rate.y() / spin_rate, 1.0, 1e-4 + restGap(0.5) / radius);
}

INSTANTIATE_TEST_SUITE_P(Rates, Incline, testing::Values(60.0, 120.0, 240.0));

}  // namespace
}  // namespace carom::physics
