#pragma once
// A smooth ball slides off a fixed one: at the angle b from the top its speed is 2 g d (cos b0 - cos b), d
// the distance of the centres, and it leaves where gravity no longer bends its path so far: cos b = 2/3 cos
// b0. From there on its level speed stays sqrt(g d cos^3 b).

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// cos b where it leaves, by its level speed in flight, over 2/3 cos b0, less one.
inline double leavingError(const Simulator& simulator, double rate_hz, double heading, double begin = 0.02) {
  constexpr double kFixed = 1.0, kRadius = 0.05;
  const double d = kFixed + kRadius + restGap(2.0 * kRadius);
  Experiment e{.step_s = 1.0 / rate_hz};
  ExperimentBody fixed{Shape::ball(kFixed)};
  fixed.friction = 0.0;
  fixed.is_static = true;
  e.add(std::move(fixed));
  const Quat turn = rotatedBy(Vec3::UnitZ(), heading);
  const int ball = e.add({.shape = Shape::ball(kRadius),
                          .X_WB = {turn, turn * Vec3(d * std::sin(begin), 0, d * std::cos(begin))},
                          .friction = 0.0});
  Trial trial(simulator, std::move(e));
  const double level = 0.2 * d;  // well below where it leaves
  for (long n = trial.stepsOf(10.0); n > 0 && trial.position(ball).z() > level; --n) trial.step();
  const double speed = trial.velocity(ball).head<2>().norm();
  return std::cbrt(speed * speed / (kGravity * d)) / (2.0 / 3.0 * std::cos(begin)) - 1.0;
}

}  // namespace carom::physics
