#pragma once
// A box a thousand times as heavy as the one it is laid on: nothing gives way, so nothing sinks in.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct HeavyLoad {
  double sunk_m = 0.0;  ///< Greatest depth of its centre below where two boxes that touch would hold it.
  bool stands = false;
};

inline HeavyLoad loadHeavyOnLight(const Simulator& simulator, double mass_ratio, double rate_hz,
                                  double side_m = 0.5, double seconds = 10.0) {
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(0.5);
  const double gap = restGap(side_m);
  const auto box = [&](double height, double mass) {
    return e.add({.shape = Shape::box(Vec3::Constant(side_m)),
                  .X_WB = {Quat::Identity(), Vec3(0, 0, height)},
                  .mass_kg = mass});
  };
  box(gap + 0.5 * side_m, 1.0);
  const int heavy = box(2.0 * gap + 1.5 * side_m, mass_ratio);
  Trial trial(simulator, std::move(e));
  HeavyLoad load;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    const double sunk = 1.5 * side_m - trial.position(heavy).z();
    if (!(sunk <= load.sunk_m)) load.sunk_m = sunk;
  }
  const Vec3 p = trial.position(heavy);
  load.stands = p.z() > 1.4 * side_m && p.head<2>().norm() < 0.1 * side_m;
  return load;
}

}  // namespace carom::physics
