#pragma once
// A ball rolls against a step of height h, without restitution and without slip. About the step's edge the
// blow keeps its angular momentum, m v (r - h) + 2/5 m r v, so that v (1 - 5/7 h / r) is left, with which it
// turns about the edge: it comes up when that is more than sqrt(10/7 g h), and what is left of the energy is
// its speed above.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct StepBall {
  double rate_hz = 60.0;
  double radius_m = 0.2;
  double height = 0.2;  ///< Of the step, in radii.
  double heading = 0.0;

  double height_m() const { return height * radius_m; }
  /// The least speed that takes it up.
  double leastSpeed() const {
    return std::sqrt(10.0 / 7.0 * kGravity * height_m()) / (1.0 - 5.0 / 7.0 * height);
  }
  /// With which it rolls on above, if it begins with `share` of the least.
  double speedAbove(double share) const {
    return std::sqrt((share * share - 1.0) * 10.0 / 7.0 * kGravity * height_m());
  }
};

/// Its velocity along its way, m/s, when it has come back or is a radius beyond the edge, on the step.
inline double speedAfterStep(const Simulator& simulator, const StepBall& ball, double share) {
  constexpr double kFriction = 1.5;
  const double r = ball.radius_m, h = ball.height_m(), v = share * ball.leastSpeed();
  const Quat turn = rotatedBy(Vec3::UnitZ(), ball.heading);
  Experiment e{.step_s = 1.0 / ball.rate_hz};
  e.addPlane(kFriction);
  ExperimentBody step{Shape::box({50.0 * r, 20.0 * r, 2.0 * r}),
                      {turn, turn * Vec3(25.0 * r, 0, h - r)}};  // its edge is at x = 0
  step.friction = kFriction;
  step.is_static = true;
  e.add(std::move(step));
  const int rolling = e.add({.shape = Shape::ball(r),
                             .X_WB = {turn, turn * Vec3(-3.0 * r, 0, r + restGap(2.0 * r))},
                             .velocity = turn * Vec3(v, 0, 0),
                             .spin = turn * Vec3(0, v / r, 0),
                             .friction = kFriction});
  Trial trial(simulator, std::move(e));
  const auto along = [&](const Vec3& u) { return u.dot(turn * Vec3::UnitX()); };
  for (long n = trial.stepsOf(20.0); n > 0; --n) {
    trial.step();
    const double x = along(trial.position(rolling));
    if (x > r || x < -4.0 * r) break;
  }
  return along(trial.velocity(rolling));
}

/// The least speed that takes it up over the closed form, less one; to 1e-4.
inline double stepError(const Simulator& simulator, const StepBall& ball) {
  return thresholdOf(0.5, 1.5, 13,
                     [&](double share) { return !(speedAfterStep(simulator, ball, share) > 0.0); }) -
         1.0;
}

}  // namespace carom::physics
