#pragma once
// A ball (2/5 m r^2) on a slope. Rolling, friction f turns it: f r = 2/5 m r^2 (a / r), so that
// a = g sin - f / m = 5/7 g sin and f = 2/7 m g sin, which the cone allows as long as mu >= 2/7 tan.

#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {

inline Trial ballOn(const Slope& slope, const Simulator& simulator, double radius_m) {
  Experiment e{.step_s = 1.0 / slope.rate_hz, .resting = slope.resting};
  const Quat tilt = slope.tilt();
  e.addPlane(slope.friction, 0.0, tilt);
  e.add({.shape = Shape::ball(radius_m),
         .X_WB = {tilt * rotatedBy({1, 2, 3}, 1.0), tilt * Vec3(-3, 0, radius_m + restGap(2.0 * radius_m))},
         .friction = slope.friction});
  return Trial(simulator, std::move(e));
}

/// Of the acceleration, relative to 5/7 g sin.
inline double rollingError(const Simulator& simulator, const Slope& slope, double radius_m = 0.25) {
  Trial trial = ballOn(slope, simulator, radius_m);
  return accelerationOf(trial, slope.tilt(), 1.0) / (5.0 / 7.0 * kGravity * std::sin(slope.angle)) - 1.0;
}

/// Speed of the ball's lowest point along the slope after a second, over that of its centre.
inline double slipShare(const Simulator& simulator, const Slope& slope, double radius_m = 0.25) {
  Trial trial = ballOn(slope, simulator, radius_m);
  trial.run(1.0);
  const Vec3 up = slope.tilt() * Vec3::UnitZ();
  const Motion m = trial.motion(kOnSlope);
  return (m.velocity - radius_m * m.spin.cross(up)).norm() / m.velocity.norm();
}

/// The least mu with which it rolls over 2/7 tan, less one. A share of 0.3 % of slip counts as rolling, for
/// those who hold the ball a little off its radius: exact rolling comes out at -0.2 %.
inline double rollingThresholdError(const Simulator& simulator, Slope slope) {
  const double expected = 2.0 / 7.0 * std::tan(slope.angle);
  const auto slips = [&](double share) {
    slope.friction = share * expected;
    return !(slipShare(simulator, slope) < 3e-3);
  };
  return thresholdOf(0.5, 1.5, 13, slips) - 1.0;
}

}  // namespace carom::physics
