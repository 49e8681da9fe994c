#pragma once
// A ball dropped from h with restitution e < 1 bounces infinitely often and yet stops. The fall takes
// t0 = sqrt(2h/g), flight k takes 2 e^k t0, and so it stops after t0 + 2 t0 (e + e^2 + ...) =
// t0 (1 + e) / (1 - e).

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

inline double closedFormBounceStop(double height_m, double restitution) {
  return std::sqrt(2.0 * height_m / kGravity) * (1.0 + restitution) / (1.0 - restitution);
}

/// When it last moved by more than a centimetre a second.
inline double bounceStop(const Simulator& simulator, double height_m, double restitution, double radius_m,
                         double rate_hz) {
  constexpr double kStopped = 0.01;  // m/s
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(0.5, restitution);
  const int ball = e.add({.shape = Shape::ball(radius_m),
                          .X_WB = {Quat::Identity(), Vec3(0.3, -0.2, height_m + radius_m)},
                          .restitution = restitution});
  Trial trial(simulator, std::move(e));
  double moved_s = 0.0;
  for (long n = trial.stepsOf(3.0 * closedFormBounceStop(height_m, restitution)); n > 0; --n) {
    trial.step();
    if (!(trial.velocity(ball).norm() <= kStopped)) moved_s = trial.time();
  }
  return moved_s;
}

}  // namespace carom::physics
