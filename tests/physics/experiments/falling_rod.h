#pragma once
// A rod that falls over on a floor without friction: nothing pushes its centre aside, and it drops by y0 - y
// as the rod turns. With the lower edge on the floor the centre is y = (L cos a + w sin a) / 2 high at the
// angle a from the vertical, and energy gives a'^2 (k^2 + (dy/da)^2) = 2 g (y0 - y), k^2 = (L^2 + w^2) / 12.
// For a thin rod (w = 0) that is 12 g (cos a0 - cos a) / (L (1 + 3 sin^2 a)).

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct FallingRod {
  double rate_hz = 60.0;
  double length_m = 1.0;
  double thickness_m = 0.02;
  double start_angle = radians(20.0);
  double heading = 0.0;

  double height(double a) const { return 0.5 * (length_m * std::cos(a) + thickness_m * std::sin(a)); }
  double closedFormRateSquared(double a) const {
    const double slope = 0.5 * (thickness_m * std::cos(a) - length_m * std::sin(a));
    const double k2 = (length_m * length_m + thickness_m * thickness_m) / 12.0;
    return 2.0 * kGravity * (height(start_angle) - height(a)) / (k2 + slope * slope);
  }
};

struct RodFall {
  double worst = 0.0;    ///< Largest relative error of the rate squared, with its sign, ...
  double aside_m = 0.0;  ///< ... and how far the centre has moved aside,
  int steps = 0;         ///< between ten degrees after the start and eighty from the vertical.
};

inline RodFall dropRod(const Simulator& simulator, const FallingRod& rod) {
  Experiment e{.step_s = 1.0 / rod.rate_hz};
  e.addPlane(0.0);
  const Quat heading = rotatedBy(Vec3::UnitZ(), rod.heading);
  const double height = rod.height(rod.start_angle) + restGap(rod.thickness_m);
  const int body = e.add({.shape = Shape::box({rod.thickness_m, rod.thickness_m, rod.length_m}),
                          .X_WB = {heading * rotatedBy(Vec3::UnitY(), rod.start_angle), Vec3(0, 0, height)},
                          .friction = 0.0});
  Trial trial(simulator, std::move(e));
  RodFall fall;
  for (long n = trial.stepsOf(5.0); n > 0; --n) {
    trial.step();
    const Motion m = trial.motion(body);
    const double a = std::acos(std::clamp((m.X_WB.rotation * Vec3::UnitZ()).z(), -1.0, 1.0));
    if (!(a < radians(80.0))) break;
    if (a < rod.start_angle + radians(10.0)) continue;
    ++fall.steps;
    const double error = m.spin.squaredNorm() / rod.closedFormRateSquared(a) - 1.0;
    if (!(std::abs(error) <= std::abs(fall.worst))) fall.worst = error;
    fall.aside_m = std::max(fall.aside_m, m.X_WB.position.head<2>().norm());
  }
  return fall;
}

}  // namespace carom::physics
