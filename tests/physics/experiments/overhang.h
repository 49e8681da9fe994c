#pragma once
// The harmonic overhang: of a stack of blocks, block k from the top reaches L/2k beyond the one below. Then
// every upper part of the stack balances on an edge, and nothing may be farther out.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// Whether eight blocks stand for five seconds with `share` of those offsets.
inline bool overhangStands(const Simulator& simulator, double share, double rate_hz, double length_m = 1.6,
                           double heading = 0.0) {
  constexpr int kBlocks = 8;
  const Vec3 size(length_m, 0.3 * length_m, 0.125 * length_m);
  const double gap = restGap(size.z()), table = 1.4 * length_m;
  const Quat turn = rotatedBy(Vec3::UnitZ(), heading);
  Experiment e{.step_s = 1.0 / rate_hz};
  ExperimentBody stand{Shape::box({2.0 * length_m, length_m, table}),
                       {turn, turn * Vec3(-length_m, 0, -0.5 * table)}};
  stand.friction = 0.7;
  stand.is_static = true;
  e.add(std::move(stand));
  double edge = 0.0, z = gap;
  int top = -1;
  for (int k = kBlocks; k > 0; --k) {
    edge += share * length_m / (2 * k);
    top = e.add({.shape = Shape::box(size),
                 .X_WB = {turn, turn * Vec3(edge - 0.5 * length_m, 0, z + 0.5 * size.z())},
                 .friction = 0.7});
    z += size.z() + gap;
  }
  Trial trial(simulator, std::move(e));
  const double begin = trial.position(top).z();
  for (long n = trial.stepsOf(5.0); n > 0; --n) {
    trial.step();
    if (!(trial.position(top).z() > begin - 0.05 * length_m)) return false;
  }
  return true;
}

}  // namespace carom::physics
