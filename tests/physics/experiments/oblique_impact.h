#pragma once
// A ball that strikes a floor obliquely, without spin, at normal speed v_n and tangential speed v_t. The
// normal impulse is m (1 + e) v_n. A point of contact of a ball (2/5 m r^2) that is pushed by J along the
// floor gains 7/2 J/m, so that it stops sliding under J = 2/7 m v_t: within the cone the ball keeps 5/7 v_t
// and rolls, beyond it loses mu (1 + e) v_n. The spin is 5/2 of the lost speed over r.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct ObliqueImpact {
  double rate_hz = 60.0;
  double friction = 0.5;
  double restitution = 0.5;
  double normal_mps = 2.0;
  double tangential_mps = 5.0;
  double heading = 0.0;
  double radius_m = 0.25;

  bool sticks() const { return 3.5 * friction * (1.0 + restitution) * normal_mps >= tangential_mps; }
  /// By which the ball slows down along the floor.
  double closedFormLoss() const {
    return sticks() ? 2.0 / 7.0 * tangential_mps : friction * (1.0 + restitution) * normal_mps;
  }
};

struct ObliqueRebound {
  double loss_mps = 0.0;
  double aside_mps = 0.0;
  double rise_mps = 0.0;
  double spin_radps = 0.0;  ///< In the sense of rolling.
};

inline ObliqueRebound reboundOf(const Simulator& simulator, const ObliqueImpact& impact) {
  Experiment e{.step_s = 1.0 / impact.rate_hz, .gravity = 0.0};
  e.addPlane(impact.friction, impact.restitution);
  const Quat heading = rotatedBy(Vec3::UnitZ(), impact.heading);
  const int ball =
      e.add({.shape = Shape::ball(impact.radius_m),
             .X_WB = {Quat::Identity(), Vec3(0.1, 0.2, 0.5 * impact.normal_mps + impact.radius_m)},
             .velocity = heading * Vec3(impact.tangential_mps, 0.0, -impact.normal_mps),
             .friction = impact.friction,
             .restitution = impact.restitution});
  Trial trial(simulator, std::move(e));
  trial.run(1.0);  // it meets the floor after half a second
  const Vec3 v = heading.conjugate() * trial.velocity(ball), w = heading.conjugate() * trial.spin(ball);
  return {impact.tangential_mps - v.x(), v.y(), v.z(), w.y()};
}

}  // namespace carom::physics
