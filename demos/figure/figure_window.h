#pragma once
// Figure 7 of the paper: the collision window. A cube's edge comes down on a plate, step by step, into it.
// Tested in tests/demos/figure/figures_test.cpp.

#include <vector>

#include "demos/figure/figure_plot.h"
#include "engine/contact/collision_window.h"

namespace carom::demos {

struct WindowFigure {
  Solid cube = Solid::box({0.7, 0.7, 0.7});
  CollisionWindow window;
  struct Instant {
    double time_s = 0.0;
    double gap_m = 0.0;
    Pose X_WCube;
  };
  std::vector<Instant> run;    ///< One a step.
  double impulse_s = 0.0;      ///< When the first collision was solved.
  double impulse_gap_m = 0.0;  ///< The gap when the first collision was solved.
  double impulse_Ns = 0.0;

  Plot plot(const PageSize& size) const;
  /// The cut through the window beside it: x in millimetres from the edge, z above the plate.
  Plot cut(const PageSize& size) const;
};
WindowFigure windowFigure();
renderer::Image drawWindowFigure(const WindowFigure& figure, const PageSize& size);

}  // namespace carom::demos
