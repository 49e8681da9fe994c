#pragma once
// A ladder leans against a smooth wall: the floor bears its weight W and holds its foot by friction F, the
// wall's push. About the foot, W x = F z, x being how far the middle is from it and z how high the head: it
// stands exactly when mu >= x / z.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct Ladder {
  double rate_hz = 60.0;
  double angle = 0.0;  ///< From the floor.
  double length_m = 2.0;
  double thickness_m = 0.02;
  double heading = 0.0;

  /// Of its foot, the least that holds it.
  double leastFriction() const {
    const double x = 0.5 * (length_m * std::cos(angle) - thickness_m * std::sin(angle));
    return x / (length_m * std::sin(angle));
  }
};

/// How far its middle goes in `seconds` with `share` of that friction.
inline double ladderSlip(const Simulator& simulator, const Ladder& ladder, double share, double seconds) {
  const double gap = restGap(ladder.thickness_m), friction = share * ladder.leastFriction();
  const Vec3 size(ladder.length_m, 0.4, ladder.thickness_m);
  const Quat turn = rotatedBy(Vec3::UnitZ(), ladder.heading), lean = rotatedBy(Vec3::UnitY(), ladder.angle);
  const Vec3 reach(0.5 * (size.x() * std::cos(ladder.angle) + size.z() * std::sin(ladder.angle)), 0.0,
                   0.5 * (size.x() * std::sin(ladder.angle) + size.z() * std::cos(ladder.angle)));
  Experiment e{.step_s = 1.0 / ladder.rate_hz};
  e.addPlane(friction);
  ExperimentBody wall{Shape::box({1.0, 10.0, 10.0}), {turn, turn * Vec3(-0.5, 0.0, 5.0 + gap)}};
  wall.friction = 0.0;
  wall.is_static = true;
  e.add(std::move(wall));
  const Vec3 middle = turn * (reach + gap * Vec3(1, 0, 1));
  const int leaning = e.add({.shape = Shape::box(size), .X_WB = {turn * lean, middle}, .friction = friction});
  Trial trial(simulator, std::move(e));
  trial.run(seconds);
  return (trial.position(leaning) - middle).norm();
}

/// The least friction with which it stands over x / z, less one; to 1e-4. A centimetre in five seconds, which
/// it goes with 1e-4 too little, counts as standing.
inline double ladderError(const Simulator& simulator, const Ladder& ladder) {
  const auto slides = [&](double share) { return !(ladderSlip(simulator, ladder, share, 5.0) < 0.01); };
  return thresholdOf(0.5, 1.5, 13, slides) - 1.0;
}

}  // namespace carom::physics
