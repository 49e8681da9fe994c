#pragma once
// After SimBenchmark's rolling test (Kang and Hwangbo, 2018): 25 balls of 1 kg on a box of 10 kg that slides
// askew on the ground (mu 0.8 and 0.4). There a force drives the box; here friction alone stops it, since not
// every library takes a force on one body. A ball without slip feels m 2/7 of the box's acceleration, and so
// a = mu g (M + 25 m) / (M + 2/7 25 m) for the box and 2/7 of it for the balls.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// Mean over time and bodies of the squared error of velocity, (m/s)^2.
inline double rollingVelocityError(const Simulator& simulator, double step_s, double heading) {
  constexpr double kBall = 1.0, kBox = 10.0, kRadius = 0.1, kSpeed = 5.0, kSeconds = 0.5;
  const Quat turn = rotatedBy(Vec3::UnitZ(), heading);
  const Vec3 along = turn * Vec3::UnitX(), size(6.0, 6.0, 0.4);
  Experiment e{.step_s = step_s};
  e.addPlane(0.2);  // sqrt(0.2 x 0.8) = 0.4
  const double top = size.z() + restGap(size.z());
  e.add({.shape = Shape::box(size),
         .X_WB = {Quat::Identity(), Vec3(0, 0, top - 0.5 * size.z())},
         .velocity = kSpeed * along,
         .mass_kg = kBox,
         .friction = 0.8});
  for (int k = 0; k < 25; ++k)
    e.add({.shape = Shape::ball(kRadius),
           .X_WB = {Quat::Identity(),
                    Vec3(0.5 * (k % 5 - 2), 0.5 * (k / 5 - 2), top + kRadius + restGap(2.0 * kRadius))},
           .velocity = kSpeed * along,
           .mass_kg = kBall,
           .friction = 0.8});
  constexpr double kBalls = 25.0 * kBall;
  const double slowing = 0.4 * kGravity * (kBox + kBalls) / (kBox + 2.0 / 7.0 * kBalls);
  Trial trial(simulator, std::move(e));
  double squares = 0.0;
  const long steps = trial.stepsOf(kSeconds);
  for (long n = steps; n > 0; --n) {
    trial.step();
    for (int k = 1; k <= 26; ++k) {
      const double rate = k == 1 ? slowing : 2.0 / 7.0 * slowing;
      squares += (trial.velocity(k) - (kSpeed - rate * trial.time()) * along).squaredNorm();
    }
  }
  return squares / (26.0 * static_cast<double>(steps));
}

}  // namespace carom::physics
