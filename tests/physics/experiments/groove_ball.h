#pragma once
// A ball rolls down a groove between two planes, each turned by b from the level: it turns about the line
// through both contacts, r cos b below its centre, so that a = g sin / (1 + 2/5 / cos^2 b).

#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {

/// Of the acceleration, relative to the closed form; `slope.friction` must be enough.
inline double grooveError(const Simulator& simulator, const Slope& slope, double opening,
                          double radius_m = 0.1) {
  constexpr double kWidth = 2.0, kThickness = 0.2;
  Experiment e{.step_s = 1.0 / slope.rate_hz, .resting = slope.resting};
  const Quat tilt = slope.tilt();
  e.add({.shape = Shape::ball(radius_m),
         .X_WB = {tilt, tilt * Vec3(-3, 0, (radius_m + restGap(2.0 * radius_m)) / std::cos(opening))},
         .friction = slope.friction});
  for (const double side : {-1.0, 1.0}) {
    const Quat bank = tilt * rotatedBy(Vec3::UnitX(), side * opening);
    ExperimentBody plane{Shape::box({40.0, kWidth, kThickness}),
                         {bank, bank * Vec3(0, 0.5 * side * kWidth, -0.5 * kThickness)}};
    plane.friction = slope.friction;
    plane.is_static = true;
    e.add(std::move(plane));
  }
  Trial trial(simulator, std::move(e));
  trial.run(1.0);
  const double cosine = std::cos(opening);
  const double expected = kGravity * std::sin(slope.angle) / (1.0 + 0.4 / (cosine * cosine));
  return trial.velocity(0).dot(tilt * Vec3::UnitX()) / expected - 1.0;
}

}  // namespace carom::physics
