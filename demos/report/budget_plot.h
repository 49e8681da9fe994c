#pragma once
// The frame times of a budget as a picture: phases stacked over the frames, the deadline, percentiles, the
// slowest frames marked, another run as a line over it. SVG that follows the reader's light or dark mode and
// prints in black on white. Tested in tests/demos/report/budget_plot_test.cpp.

#include <string>
#include <vector>

#include "demos/motion/frame_cost.h"

namespace carom::demos {

struct BudgetPlot {
  std::string title;
  std::vector<FrameCost> frames;   ///< In order; at least one.
  double budget_ms = 0.0;          ///< 0: no deadline is drawn.
  std::vector<double> other_ms;    ///< Another run's frame times; empty: none.
  std::string other;               ///< Whose these are.
  std::vector<std::string> notes;  ///< Lines below the plot: the verdict.
};

std::string plotSvg(const BudgetPlot& plot);
/// The same in a page of its own, which opens from disk.
std::string plotPage(const BudgetPlot& plot);

}  // namespace carom::demos
