#pragma once
// Coulomb friction on a block: along a level floor it stops after v^2 / 2 mu g; down an incline it gains
// g (sin - mu cos); it stays where it is as long as tan <= mu, for any time. Whichever way it is headed.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct Slope {
  double rate_hz = 60.0;
  double angle = 0.0;
  double friction = 0.5;
  double heading = 0.0;  ///< Of the slope about the vertical.
  double turn = 0.0;     ///< Of the block on the slope.
  bool resting = true;
  double velocity_mps = 0.0;  ///< Of the start, down the slope (along the heading on a level floor).

  /// The slope falls off along its own x.
  Quat tilt() const { return rotatedBy(Vec3::UnitZ(), heading) * rotatedBy(Vec3::UnitY(), angle); }
};

inline constexpr int kOnSlope = 1;  ///< The block or ball of a slope's experiment; the plane is 0.

inline Trial blockOn(const Slope& slope, const Simulator& simulator, const Vec3& size = {0.6, 0.5, 0.2}) {
  Experiment e{.step_s = 1.0 / slope.rate_hz, .resting = slope.resting};
  const Quat tilt = slope.tilt();
  e.addPlane(slope.friction, 0.0, tilt);
  e.add({.shape = Shape::box(size),
         .X_WB = {tilt * rotatedBy(Vec3::UnitZ(), slope.turn),
                  tilt * Vec3(0, 0, 0.5 * size.z() + restGap(size.minCoeff()))},
         .velocity = tilt * Vec3(slope.velocity_mps, 0, 0),
         .friction = slope.friction});
  return Trial(simulator, std::move(e));
}

/// Path over v^2 / 2 mu g, less one; NaN while it still moves after twice its time.
inline double stoppingError(const Simulator& simulator, const Slope& level) {
  Trial trial = blockOn(level, simulator);
  const Vec3 begin = trial.position(kOnSlope);
  trial.run(2.0 * level.velocity_mps / (level.friction * kGravity) + 0.5);
  const double expected = level.velocity_mps * level.velocity_mps / (2.0 * level.friction * kGravity);
  if (!(trial.velocity(kOnSlope).norm() < 0.01)) return std::numeric_limits<double>::quiet_NaN();
  return (trial.position(kOnSlope) - begin).head<2>().norm() / expected - 1.0;
}

/// Down the slope, m/s^2, over the second half of `seconds`.
inline double accelerationOf(Trial& trial, const Quat& tilt, double seconds) {
  const Vec3 down = tilt * Vec3::UnitX();
  trial.run(0.5 * seconds);
  const double before = trial.velocity(kOnSlope).dot(down), from = trial.time();
  trial.run(0.5 * seconds);
  return (trial.velocity(kOnSlope).dot(down) - before) / (trial.time() - from);
}

inline double inclineError(const Simulator& simulator, const Slope& slope) {
  Trial trial = blockOn(slope, simulator);
  const double expected = kGravity * (std::sin(slope.angle) - slope.friction * std::cos(slope.angle));
  return accelerationOf(trial, slope.tilt(), 1.0) / expected - 1.0;
}

/// tan of the steepest slope that holds the block, over mu, less one; to 1e-5. Held is what does not gain
/// speed: a slope 3e-5 too steep for mu = 0.5 gives it 1e-4 m/s^2.
inline double stickSlipError(const Simulator& simulator, Slope slope) {
  constexpr double kHeld = 1e-4;  // m/s^2
  const auto holds = [&](double share) {
    slope.angle = std::atan(share * slope.friction);
    Trial trial = blockOn(slope, simulator);
    return accelerationOf(trial, slope.tilt(), 4.0) < kHeld;
  };
  return thresholdOf(0.5, 1.5, 17, holds) - 1.0;
}

/// How far it creeps along the slope from the first second on, metres.
inline double creepOf(const Simulator& simulator, const Slope& slope, double seconds) {
  Trial trial = blockOn(slope, simulator);
  trial.run(1.0);
  const Vec3 begin = trial.position(kOnSlope);
  trial.run(seconds);
  const Vec3 moved = slope.tilt().conjugate() * (trial.position(kOnSlope) - begin);
  return moved.head<2>().norm();
}

}  // namespace carom::physics
