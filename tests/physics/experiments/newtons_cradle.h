#pragma once
// Newton's cradle without strings and gravity: a ball strikes a row of four at e = 1. Passed from pair to
// pair, momentum and energy leave one way: the last flies off with the speed of the first, and the others
// stand.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// What the five have along the row at the end, the speed of the first being one.
inline std::array<double, 5> cradleSpeeds(const Simulator& simulator, double gap_m, double rate_hz,
                                          double radius_m = 0.1, double heading = 0.0) {
  constexpr double kSpeed = 2.0;
  const Vec3 along = rotatedBy(Vec3::UnitZ(), heading) * Vec3::UnitX();
  Experiment e{.step_s = 1.0 / rate_hz, .gravity = 0.0};
  for (int k = 0; k < 5; ++k) {
    const double x = k * (2.0 * radius_m + gap_m) - (k == 0 ? 0.7 : 0.0);
    e.add({.shape = Shape::ball(radius_m),
           .X_WB = {Quat::Identity(), x * along},
           .velocity = k == 0 ? Vec3(kSpeed * along) : Vec3(Vec3::Zero()),
           .friction = 0.0,
           .restitution = 1.0});
  }
  Trial trial(simulator, std::move(e));
  trial.run(1.0);
  std::array<double, 5> speeds{};
  for (int k = 0; k < 5; ++k) speeds[static_cast<std::size_t>(k)] = trial.velocity(k).dot(along) / kSpeed;
  return speeds;
}

/// The largest departure from 0 0 0 0 1.
inline double cradleError(const std::array<double, 5>& speeds) {
  double worst = 0.0;
  for (std::size_t k = 0; k < 5; ++k) {
    const double error = std::abs(speeds[k] - (k == 4 ? 1.0 : 0.0));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

}  // namespace carom::physics
