#pragma once
// The rows of `piles` (piles.cpp has the command line): bodies that are dropped or stand, described once for
// every library. Tested in tests/bench/pile_rows_test.cpp.

#include <functional>
#include <string>
#include <vector>

#include "tests/physics/experiments/experiment.h"

namespace carom::bench {

struct PileRow {
  std::string name;  ///< Lower case, hyphens: what is typed to ask for it.
  std::string what;
  std::function<physics::Experiment()> describe;
  double longest_s = 6.0;   ///< Simulated until quiet, or so long.
  bool until_quiet = true;  ///< Else all of `longest_s`, ...
  double settling_s = 0.0;  ///< ... of which so much comes before the clock.
  int size = 0;             ///< Bodies that can move, of rows of which the growth is asked.
  bool is_long = false;     ///< Takes minutes: runs only when asked for.
};
std::vector<PileRow> dropRows();

}  // namespace carom::bench
