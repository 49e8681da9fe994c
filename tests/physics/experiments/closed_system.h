#pragma once
// Balls and boxes of different mass that meet in free space with friction and restitution: nothing from
// outside acts on them, and momentum and angular momentum stay.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct MomentumError {
  double linear = 0.0;       ///< Largest change over the sum of all m |v| of the start.
  double angular = 0.0;      ///< Largest change over the sum of all |r x m v + I w| of the start.
  double energy_lost = 0.0;  ///< Share of the start: it shows that they have met.
};

inline MomentumError collideInFreeSpace(const Simulator& simulator, double rate_hz, double seconds,
                                        double friction = 0.3, double restitution = 0.5) {
  Experiment e{.step_s = 1.0 / rate_hz, .gravity = 0.0};
  double linear_scale = 0.0, angular_scale = 0.0;
  for (int k = 0; k < 12; ++k) {
    const Vec3 out(std::cos(2.4 * k), std::sin(2.4 * k), 0.8 * std::cos(1.1 * k + 0.4));
    ExperimentBody b{k % 2 == 0 ? Shape::ball(0.2) : Shape::box({0.5, 0.3, 0.4})};
    b.X_WB = {rotatedBy({1.0, 0.3 * k, -0.5}, 0.7 * k), (1.2 + 0.12 * k) * out};
    b.velocity = -(1.5 + 0.1 * k) * out + 0.2 * out.cross(Vec3::UnitZ());
    b.spin = Vec3(0.9 - 0.2 * k, 1.0, 0.3 * k - 1.4);
    b.mass_kg = 1.0 + 0.7 * k;
    b.friction = friction;
    b.restitution = restitution;
    linear_scale += b.mass_kg * b.velocity.norm();
    const Quat& R = b.X_WB.rotation;
    angular_scale +=
        (R * (b.inertia() * (R.conjugate() * b.spin)) + b.mass_kg * b.X_WB.position.cross(b.velocity)).norm();
    e.add(std::move(b));
  }
  Trial trial(simulator, std::move(e));
  const Vec3 linear = trial.linearMomentum(), angular = trial.angularMomentum();
  const double energy = trial.kineticEnergy();
  MomentumError error;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    error.linear = std::max(error.linear, (trial.linearMomentum() - linear).norm() / linear_scale);
    error.angular = std::max(error.angular, (trial.angularMomentum() - angular).norm() / angular_scale);
  }
  error.energy_lost = 1.0 - trial.kineticEnergy() / energy;
  return error;
}

}  // namespace carom::physics
