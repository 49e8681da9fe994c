#pragma once
// A solid ball (2/5 m r^2) whose contact bears a torque of at most c N against rolling and s N against
// spinning about its normal (Johnson, Contact Mechanics, 9.2: Coulomb's lever of rolling friction).
//
// Rolling on the level: m a = F, 2/5 m r^2 a / r = -c m g - F r, so that a = -5/7 g c / r: it goes v^2 /
// 2|a|. Down a slope: 5/7 g (sin - c cos / r). On it, the weight's moment m g r sin about the contact is held
// as long as tan <= c / r. Spinning on the spot: 2/5 m r^2 w' = -s m g, so that it stops after 2/5 r^2 w / (g
// s).

#include "tests/physics/experiments/sliding_block.h"

namespace carom::physics {

struct ResistedBall {
  double rate_hz = 60.0;
  double radius_m = 0.25;
  double mass_kg = 1.0;
  double rolling = 0.0;   ///< c / r.
  double spinning = 0.0;  ///< s / r.
  double angle = 0.0;     ///< Of the slope, which falls off along the heading.
  double heading = 0.0;
  double velocity_mps = 0.0;  ///< Of the start, rolling along the heading.
  double spin_radps = 0.0;    ///< Of the start, about the normal.
  bool resting = false;
  double friction = 2.0;

  Quat tilt() const { return Slope{.angle = angle, .heading = heading}.tilt(); }
  Vec3 along() const { return tilt() * Vec3::UnitX(); }
  Vec3 up() const { return tilt() * Vec3::UnitZ(); }
  /// On the level, and down a slope; both positive as speed is lost.
  double deceleration() const { return 5.0 / 7.0 * kGravity * (rolling * std::cos(angle) - std::sin(angle)); }
  double spinDeceleration() const { return 2.5 * kGravity * spinning / radius_m; }
};

inline Trial start(const Simulator& simulator, const ResistedBall& b) {
  Experiment e{.step_s = 1.0 / b.rate_hz, .resting = b.resting};
  e.addPlane(b.friction, 0.0, b.tilt());
  e.bodies[0].rolling_resistance_m = b.rolling * b.radius_m;
  e.bodies[0].spinning_resistance_m = b.spinning * b.radius_m;
  e.add({.shape = Shape::ball(b.radius_m),
         .X_WB = {b.tilt() * rotatedBy({1, 2, 3}, 1.0),
                  b.tilt() * Vec3(0, 0, b.radius_m + restGap(2.0 * b.radius_m))},
         .velocity = b.velocity_mps * b.along(),
         .spin = b.velocity_mps / b.radius_m * b.up().cross(b.along()) + b.spin_radps * b.up(),
         .mass_kg = b.mass_kg,
         .friction = b.friction,
         .rolling_resistance_m = b.rolling * b.radius_m,
         .spinning_resistance_m = b.spinning * b.radius_m});
  return Trial(simulator, std::move(e));
}

/// Of what a ball loses in half its time of a speed, which is asked of the trial, relative to the closed
/// form.
template <typename Speed>
double lossError(Trial trial, double deceleration, const Speed& speed) {
  const double begin = speed(trial);
  trial.run(0.5 * begin / deceleration);
  return (begin - speed(trial)) / (deceleration * trial.time()) - 1.0;
}
/// Of rolling.
inline double rollingLossError(const Simulator& simulator, const ResistedBall& ball) {
  return lossError(start(simulator, ball), ball.deceleration(),
                   [&](const Trial& trial) { return trial.velocity(kOnSlope).dot(ball.along()); });
}
/// Of spinning on the spot.
inline double spinLossError(const Simulator& simulator, const ResistedBall& ball) {
  return lossError(start(simulator, ball), ball.spinDeceleration(),
                   [&](const Trial& trial) { return trial.spin(kOnSlope).dot(ball.up()); });
}

/// Of the whole way of a ball that rolls to its stop, relative to v^2 / 2a; NaN while it still moves after
/// twice its time.
inline double rollingWayError(const Simulator& simulator, const ResistedBall& ball) {
  Trial trial = start(simulator, ball);
  const Vec3 begin = trial.position(kOnSlope);
  trial.run(2.0 * ball.velocity_mps / ball.deceleration());
  if (!(trial.velocity(kOnSlope).norm() < 1e-9)) return std::numeric_limits<double>::quiet_NaN();
  const double way = ball.velocity_mps * ball.velocity_mps / (2.0 * ball.deceleration());
  return (trial.position(kOnSlope) - begin).norm() / way - 1.0;
}

/// The time until it spins no more, over 2/5 r^2 w / (g s), less one; steps round it up.
inline double spinTimeError(const Simulator& simulator, const ResistedBall& ball) {
  Trial trial = start(simulator, ball);
  const double expected = ball.spin_radps / ball.spinDeceleration();
  while (trial.spin(kOnSlope).norm() > 1e-9 * ball.spin_radps && trial.time() < 2.0 * expected) trial.step();
  return trial.time() / expected - 1.0;
}

/// tan of the steepest slope that holds it, over c / r, less one; to 1e-4. Held is what gains no speed.
inline double standingThresholdError(const Simulator& simulator, ResistedBall ball) {
  constexpr double kHeld = 1e-6;  // m/s^2
  const auto holds = [&](double share) {
    ball.angle = std::atan(share * ball.rolling);
    Trial trial = start(simulator, ball);
    return accelerationOf(trial, ball.tilt(), 2.0) < kHeld;
  };
  return thresholdOf(0.5, 1.5, 13, holds) - 1.0;
}

}  // namespace carom::physics
