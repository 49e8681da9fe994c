#pragma once
// A row of dominoes. Its wave has no closed form of its own, but nothing in it has a scale except g and the
// size: the speed goes as sqrt(g l), and a row four times as large in everything runs twice as fast.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// Metres a second between the eighth and the twentieth, from when they lean by a tenth of a radian; NaN when
/// the wave does not come so far.
inline double dominoSpeed(const Simulator& simulator, double scale, double rate_hz, double heading = 0.0) {
  constexpr int kCount = 24, kFrom = 8, kTo = 20;
  constexpr double kLean = 0.1;
  const Vec3 size = scale * Vec3(0.07, 0.2, 0.4);
  const double pitch = 0.18 * scale, height = 0.5 * size.z() + restGap(size.x());
  const Quat turn = rotatedBy(Vec3::UnitZ(), heading);
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(0.3);
  for (int k = 0; k < kCount; ++k)
    e.add({.shape = Shape::box(size), .X_WB = {turn, turn * Vec3(k * pitch, 0, height)}, .friction = 0.3});
  const double push = 1.6 / std::sqrt(scale);  // rad/s about the first one's lower front edge
  e.bodies[1].velocity = turn * (0.5 * push * Vec3(size.z(), 0, size.x()));
  e.bodies[1].spin = turn * Vec3(0, push, 0);
  Trial trial(simulator, std::move(e));
  double from_s = 0.0, to_s = 0.0, lean_from = 0.0, lean_to = 0.0;
  const auto lean = [&](int k) { return (trial.motion(k).X_WB.rotation * Vec3::UnitZ()).head<2>().norm(); };
  const auto crossed = [&](int k, double& before, double& when_s) {
    const double now = lean(k);
    if (when_s == 0.0 && now >= kLean)
      when_s = trial.time() - trial.experiment().step_s * (now - kLean) / (now - before);
    before = now;
  };
  for (long n = trial.stepsOf(4.0 * std::sqrt(scale)); n > 0 && to_s == 0.0; --n) {
    trial.step();
    crossed(kFrom, lean_from, from_s);
    crossed(kTo, lean_to, to_s);
  }
  if (to_s == 0.0 || from_s == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return (kTo - kFrom) * pitch / (to_s - from_s);
}

}  // namespace carom::physics
