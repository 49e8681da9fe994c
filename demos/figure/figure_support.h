#pragma once
// Figures 9 and 10 of the paper: the support polygon of a table that has come to rest, and the projection of
// its centre of mass in the direction of gravity; once as it stands, once seen along gravity. Tested in
// tests/demos/figure/figures_test.cpp.

#include <vector>

#include "demos/figure/figure_plot.h"
#include "engine/simulation/world.h"

namespace carom::demos {

struct SupportFigure {
  World world{WorldSettings{}};
  std::vector<Vec3> points_W;  ///< Of contact, from the run's last step.
  std::vector<Vec3> cover_W;   ///< The convex cover, on the floor's level.
  Vec3 center_W = Vec3::Zero();
  Vec3 foot_W = Vec3::Zero();  ///< The centre of mass, projected along gravity.
  double outside_m = 0.0;      ///< By how much the foot misses the cover.
  double rest_s = 0.0;         ///< When the table came to rest.
  renderer::Camera camera;

  /// The view along gravity, metres.
  Plot plan(const PageSize& size) const;
};
SupportFigure supportFigure(const PageSize& size);
/// Figure 9.
renderer::Image drawSupportFigure(const SupportFigure& figure, const PageSize& size);
/// Figure 10.
renderer::Image drawSupportPlan(const SupportFigure& figure, const PageSize& size);

}  // namespace carom::demos
