#pragma once
// Four equal balls: one on three that touch. A ball below has three forces, of which the weight and the
// floor's act in the line through the lowest point; so the one from above passes through that point, too, and
// leaves the contact's normal by half the angle b between this and the vertical: mu >= tan(b / 2) = sqrt 3 -
// sqrt 2. The floor bears 4/3 of a weight and holds tan(b / 2) / 3 of one: there mu >= (sqrt 3 - sqrt 2) / 4.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct FourBalls {
  double rate_hz = 60.0;
  double radius_m = 0.5;
  double between = 0.6;  ///< Friction of two balls.
  double below = 0.5;    ///< That of a ball and the floor.
  double heading = 0.0;
};

inline double leastFrictionOfBalls() {
  return std::sqrt(3.0) - std::sqrt(2.0);
}

/// How far the uppermost has come down after `seconds`.
inline double fourBallsDrop(const Simulator& simulator, const FourBalls& balls, double seconds) {
  const double r = balls.radius_m, gap = restGap(2.0 * r), apart = 2.0 * r + gap;
  const double beside = apart / std::sqrt(3.0);
  Experiment e{.step_s = 1.0 / balls.rate_hz};
  e.addPlane(balls.below * balls.below / balls.between);  // the mean of the floor's and a ball's is `below`
  const auto add = [&](const Vec3& p) {
    return e.add({.shape = Shape::ball(r), .X_WB = {Quat::Identity(), p}, .friction = balls.between});
  };
  for (int k = 0; k < 3; ++k)
    add(rotatedBy(Vec3::UnitZ(), balls.heading + radians(120.0 * k)) * Vec3(beside, 0, 0) +
        Vec3(0, 0, r + gap));
  const double height = r + gap + apart * std::sqrt(2.0 / 3.0);
  const int top = add(Vec3(0, 0, height));
  Trial trial(simulator, std::move(e));
  trial.run(seconds);
  return height - trial.position(top).z();
}

/// The least friction between the balls, or below them, with which they stand over the closed form, less one;
/// to 1e-4. A hundredth of the radius in five seconds counts as standing.
inline double fourBallsError(const Simulator& simulator, FourBalls balls, double FourBalls::*friction,
                             double expected) {
  const auto fall = [&](double share) {
    balls.*friction = share * expected;
    return !(std::abs(fourBallsDrop(simulator, balls, 5.0)) < 0.01 * balls.radius_m);
  };
  return thresholdOf(0.5, 1.5, 13, fall) - 1.0;
}

}  // namespace carom::physics
