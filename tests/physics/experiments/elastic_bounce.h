#pragma once
// A body that bounces on a floor without friction at e = 1: conservation of energy is its closed form, at any
// step and for any attitude.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct EnergyRange {
  double lowest = 0.0, highest = 0.0;  ///< Of E / E0 - 1 over the ends of the steps.
  double worst() const { return -lowest > highest ? lowest : highest; }
};

inline EnergyRange bounceElastically(const Simulator& simulator, const Shape& shape, const Quat& attitude,
                                     double rate_hz, double seconds) {
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(0.0, 1.0);
  e.add({.shape = shape,
         .X_WB = {attitude, Vec3(0, 0, 1.0 + shape.solid.radius())},
         .friction = 0.0,
         .restitution = 1.0});
  Trial trial(simulator, std::move(e));
  const double begin = trial.energy();
  EnergyRange range;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    const double error = trial.energy() / begin - 1.0;
    if (!(error >= range.lowest)) range.lowest = error;  // true of no number, too
    if (!(error <= range.highest)) range.highest = error;
  }
  return range;
}

}  // namespace carom::physics
