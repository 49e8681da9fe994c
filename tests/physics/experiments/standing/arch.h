#pragma once
// A semicircular arch of equal voussoirs without mortar, mean radius R, thickness t: it stands under its own
// weight as long as the line of thrust finds room in it, t / R >= 0.1075 (Milankovitch 1907), and opens at
// five hinges below.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

/// How far the keystone has come down after `seconds`; more than R / 10 as soon as it has.
inline double archDrop(const Simulator& simulator, double thickness_over_radius, double rate_hz,
                       double seconds = 4.0, double radius_m = 2.0) {
  constexpr int kStones = 21;
  constexpr double kFriction = 0.9;
  const double thick = thickness_over_radius * radius_m, depth = 0.4 * radius_m, gap = 1e-4 * radius_m;
  const double half = 0.5 * std::numbers::pi / kStones;
  std::vector<Vec3> points;
  for (double y : {-0.5 * depth, 0.5 * depth})
    for (double r : {radius_m - 0.5 * thick, radius_m + 0.5 * thick})
      for (double side : {-1.0, 1.0})
        points.emplace_back(r * std::cos(half) - radius_m, y, side * (r * std::sin(half) - 0.5 * gap));
  const Shape stone = Shape::hull(points);
  Experiment e{.step_s = 1.0 / rate_hz};
  e.addPlane(kFriction);
  for (int k = 0; k < kStones; ++k) {
    const double middle = std::numbers::pi * (k + 0.5) / kStones;
    const Pose X_WD{rotatedBy(Vec3::UnitY(), -middle),
                    Vec3(radius_m * std::cos(middle), 0, radius_m * std::sin(middle) + gap)};
    e.add({.shape = stone,
           .X_WB = X_WD * Pose{Quat::Identity(), -stone.solid.origin_B()},
           .friction = kFriction});
  }
  const int keystone = kStones / 2 + 1;
  Trial trial(simulator, std::move(e));
  const double begin = trial.position(keystone).z();
  double drop = 0.0;
  for (long n = trial.stepsOf(seconds); n > 0 && drop <= 0.1 * radius_m; --n) {
    trial.step();
    const double now = begin - trial.position(keystone).z();
    drop = std::isfinite(now) ? now : std::numeric_limits<double>::infinity();
  }
  return drop;
}

inline bool archStands(const Simulator& simulator, double thickness_over_radius, double rate_hz,
                       double seconds = 4.0, double radius_m = 2.0) {
  return archDrop(simulator, thickness_over_radius, rate_hz, seconds, radius_m) < 0.1 * radius_m;
}

}  // namespace carom::physics
