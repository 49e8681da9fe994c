#pragma once
// Boxes that were laid on each other and must stay where they are: a stack, a pyramid, a wall. Every one lies
// on its whole face, so theory moves none of them by anything.

#include "tests/physics/experiments/experiment.h"

namespace carom::physics {

struct Standing {
  double drift_m = 0.0;  ///< Greatest way of a box along the floor, over the whole time, ...
  double sag_m = 0.0;    ///< ... and downwards.
  double rest_s = 0.0;   ///< When the last one was put to rest; as long as the run when one never was.
};

inline Standing standFor(Trial trial, double seconds) {
  const int bodies = static_cast<int>(trial.experiment().bodies.size());
  Standing standing;
  for (long n = trial.stepsOf(seconds); n > 0; --n) {
    trial.step();
    for (int i = 1; i < bodies; ++i) {
      const Vec3 moved =
          trial.position(i) - trial.experiment().bodies[static_cast<std::size_t>(i)].X_WB.position;
      if (const double drift = moved.head<2>().norm(); !(drift <= standing.drift_m)) standing.drift_m = drift;
      if (!(-moved.z() <= standing.sag_m)) standing.sag_m = -moved.z();
      if (!trial.atRest(i)) standing.rest_s = trial.time();
    }
  }
  return standing;
}

struct Rest {
  double rest_s = 0.0;   ///< When the last box was put to rest; as long as the run when one never was.
  double moved_m = 0.0;  ///< Farthest way of a box from then on, ...
  bool unturned = true;  ///< ... and whether all kept their attitudes to the last bit.
};

inline Rest restFor(Trial trial, double seconds) {
  const std::size_t bodies = trial.experiment().bodies.size();
  const auto all_rest = [&] {
    for (std::size_t i = 1; i < bodies; ++i)
      if (!trial.atRest(static_cast<int>(i))) return false;
    return true;
  };
  const long steps = trial.stepsOf(seconds);
  long n = 0;
  while (n < steps && !all_rest()) trial.step(), ++n;
  Rest rest{.rest_s = trial.time()};
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < bodies; ++i) poses.push_back(trial.motion(static_cast<int>(i)).X_WB);
  for (; n < steps; ++n) {
    trial.step();
    for (std::size_t i = 1; i < bodies; ++i) {
      const Pose X_WB = trial.motion(static_cast<int>(i)).X_WB;
      const double moved_m = (X_WB.position - poses[i].position).norm();
      if (!(moved_m <= rest.moved_m)) rest.moved_m = moved_m;
      rest.unturned = rest.unturned && X_WB.rotation.coeffs() == poses[i].rotation.coeffs();
    }
  }
  return rest;
}

inline void layBox(Experiment& e, const Vec3& size, const Vec3& position, double turn = 0.0) {
  e.add({.shape = Shape::box(size),
         .X_WB = {rotatedBy(Vec3::UnitZ(), turn), position},
         .mass_kg = 700.0 * size.prod()});
}

/// Cubes, each turned by `turn` on the one below.
inline Experiment boxStack(int boxes, double rate_hz, bool resting, double side_m = 0.5, double turn = 0.0) {
  Experiment e{.step_s = 1.0 / rate_hz, .resting = resting};
  e.addPlane(0.5);
  for (int i = 0; i < boxes; ++i)
    layBox(e, Vec3::Constant(side_m), Vec3(0, 0, restGap(side_m) * (i + 1) + side_m * (i + 0.5)), turn * i);
  return e;
}

/// Rows of one box less each.
inline Experiment boxPyramid(int rows, double rate_hz, bool resting) {
  const Vec3 size(0.5, 0.5, 0.3);
  const double gap = restGap(size.z()), pitch = 0.53;
  Experiment e{.step_s = 1.0 / rate_hz, .resting = resting};
  e.addPlane(0.5);
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < rows - r; ++k)
      layBox(e, size, {(k - 0.5 * (rows - r - 1)) * pitch, 0, gap * (r + 1) + size.z() * (r + 0.5)});
  return e;
}

/// A running bond; rows of `columns` bricks and of one less.
inline Experiment brickWall(int rows, int columns, double rate_hz, bool resting) {
  const Vec3 size(0.6, 0.3, 0.25);
  const double gap = restGap(size.z()), pitch = size.x() + 0.002;
  Experiment e{.step_s = 1.0 / rate_hz, .resting = resting};
  e.addPlane(0.5);
  for (int r = 0; r < rows; ++r) {
    const int n = columns - r % 2;
    for (int k = 0; k < n; ++k)
      layBox(e, size, {(k - 0.5 * (n - 1)) * pitch, 0, gap * (r + 1) + size.z() * (r + 0.5)});
  }
  return e;
}

}  // namespace carom::physics
