#pragma once
// Figure 6 of the paper: the distance d(t) of two bodies with its roots. A thrown rod turns over a plate; had
// it hit nothing, its distance would pass zero many times. Tested in tests/demos/figure/figures_test.cpp.

#include <vector>

#include "demos/figure/figure_plot.h"
#include "engine/motion/trajectory.h"
#include "engine/simulation/world.h"

namespace carom::demos {

struct DistanceFigure {
  Solid plate = Solid::box({6.0, 3.0, 2.0});  ///< Its top at z = 0.
  Solid rod = Solid::box({1.6, 0.22, 0.22});
  Pose X_WPlate;
  Trajectory path;  ///< Of the rod, as if it hit nothing.
  double duration_s = 0.6;
  std::vector<Vec2> free_curve;  ///< (t, d): seconds and metres, along that path; d < 0 is the exact depth.
  std::vector<Vec2> run_curve;   ///< The same of the world's run, which answers the first root.
  std::vector<double> roots_s;   ///< Where the free curve enters and leaves zero, in order.
  double collision_s = 0.0;      ///< The first in the run.

  /// d at an instant of the free path.
  double freeDistance(double t_s) const;
  Plot plot(const PageSize& size) const;
};
DistanceFigure distanceFigure();
renderer::Image drawDistanceFigure(const DistanceFigure& figure, const PageSize& size);

}  // namespace carom::demos
