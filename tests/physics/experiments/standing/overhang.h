#pragma once
// The harmonic overhang: of a stack of blocks, block k from the top reaches L/2k beyond the one below. Then
// every upper part of the stack balances on an edge, and nothing may be farther out.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// How far the uppermost of eight blocks with `share` of those offsets has come down after five seconds; more
/// than L / 20 as soon as it has.
inline double overhangDrop(const Simulator& simulator, double share, double rate_hz, double length_m = 1.6,
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
  double drop = 0.0;
  for (long n = trial.stepsOf(5.0); n > 0 && drop <= 0.05 * length_m; --n) {
    trial.step();
    const double now = begin - trial.position(top).z();
    drop = std::isfinite(now) ? now : std::numeric_limits<double>::infinity();
  }
  return drop;
}

inline bool overhangStands(const Simulator& simulator, double share, double rate_hz, double length_m = 1.6,
                           double heading = 0.0) {
  return overhangDrop(simulator, share, rate_hz, length_m, heading) < 0.05 * length_m;
}

}  // namespace carom::physics
