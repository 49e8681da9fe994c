#pragma once
// A free body that spins about its middle axis turns over again and again (Dzhanibekov). Angular momentum and
// energy are kept, and the time between two flips is the closed form of Euler's equations (Landau, Lifshitz:
// Mechanics, §37): half the period 4 K(k) / rate of the Jacobi elliptic functions.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct Top {
  Vec3 moments = Vec3::Zero();  ///< Rising.
  double energy = 0.0;
  double momentum_squared = 0.0;

  /// Of a body with these moments about its axes, and this spin seen from it.
  static Top spinning(const Vec3& moments, const Vec3& spin_B) {
    const Vec3 momentum = moments.cwiseProduct(spin_B);
    return {moments, 0.5 * spin_B.dot(momentum), momentum.squaredNorm()};
  }
};

// Where L^2 < 2 E I2 the axes of the least and largest moment change places.
inline double closedFormFlipPeriod(const Top& top) {
  double low = top.moments[0], high = top.moments[2];
  const double middle = top.moments[1];
  if (top.momentum_squared < 2.0 * top.energy * middle) std::swap(low, high);
  const double slow = (high - middle) * (top.momentum_squared - 2.0 * top.energy * low);
  const double fast = (middle - low) * (2.0 * top.energy * high - top.momentum_squared);
  return 2.0 * std::comp_ellint_1(std::sqrt(fast / slow)) * std::sqrt(low * middle * high / slow);
}

struct GyroscopeErrors {
  double energy = 0.0;       ///< Worst E / E0 - 1, with its sign.
  double momentum = 0.0;     ///< Worst |L - L0| / |L0|.
  double flip_period = 0.0;  ///< Relative; NaN with fewer than three flips.
};

/// A box of sides a > b > c: x has the least moment, z the largest, so y is the middle axis.
inline GyroscopeErrors spinGyroscope(const Simulator& simulator, double spin_radps, double seconds) {
  const Quat attitude = rotatedBy({3, -1, 2}, 1.1);
  const Vec3 spin_B = spin_radps * Vec3(0.02, 1.0, 0.03);
  Experiment e{.gravity = 0.0};
  const int body = e.add(
      {.shape = Shape::box({0.9, 0.6, 0.2}), .X_WB = {attitude, Vec3::Zero()}, .spin = attitude * spin_B});
  const Top top = Top::spinning(e.bodies[0].inertia().diagonal(), spin_B);
  Trial trial(simulator, std::move(e));
  const auto aboutMiddle = [&] {
    const Motion m = trial.motion(body);
    return (m.X_WB.rotation.conjugate() * m.spin).y();
  };
  const Vec3 momentum = trial.angularMomentum();
  GyroscopeErrors errors;
  double first = 0.0, last = 0.0, before = aboutMiddle();
  int flips = 0;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    const double energy = trial.kineticEnergy() / top.energy - 1.0;
    if (!(std::abs(energy) <= std::abs(errors.energy))) errors.energy = energy;
    errors.momentum =
        std::max(errors.momentum, (trial.angularMomentum() - momentum).norm() / momentum.norm());
    // It passes zero along a straight line (sn has no second derivative there): a chord is of third order.
    const double now = aboutMiddle();
    if (before * now < 0.0) {
      last = trial.time() - trial.experiment().step_s * now / (now - before);
      if (flips++ == 0) first = last;
    }
    before = now;
  }
  errors.flip_period = flips >= 3 ? (last - first) / (flips - 1) / closedFormFlipPeriod(top) - 1.0
                                  : std::numeric_limits<double>::quiet_NaN();
  return errors;
}

}  // namespace carom::physics
