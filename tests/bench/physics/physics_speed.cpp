// physics: what fast bodies come through, with the peers' continuous collision off and on.

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/shots.h"

namespace carom::bench {
namespace {

using namespace physics;
using Shots = double (*)(const Simulator&, const ShotPlan&);

// "0-64 %": the least and the greatest share over the speeds.
Figure sharesOver(const Simulator& s, Shots shots, const std::vector<double>& speeds, bool continuous) {
  double low = 1.0, high = 0.0;
  for (double speed : speeds) {
    const double share = shots(s, {.speed = speed, .continuous_collision = continuous});
    low = std::min(low, share);
    high = std::max(high, share);
  }
  const std::string least = within("%.0f", 100.0 * low, 0, 0).text,
                    most = within("%.0f %%", 100.0 * high, 0, 0).text;
  return {low == high ? most : least + "-" + most, high == 0.0};
}

Row shotRow(const char* name, const char* what, Shots shots, const std::vector<double>& speeds) {
  const auto measure = [=](const Simulator& s) {
    return allOf({sharesOver(s, shots, speeds, false), sharesOver(s, shots, speeds, true)});
  };
  return {name, std::string(what) + ": came through, peers' CCD off / on", "0", "0 %", measure};
}

}  // namespace

std::vector<Row> speedRows() {
  const std::vector<double> fast = {10.0, 30.0, 100.0, 300.0, 1000.0};
  return {shotRow("wall-shots", "0.1 m box at 10 to 1000 m/s into a wall of 2 cm", passedTheWall, fast),
          shotRow("head-on", "two such boxes head on", changedSides, fast),
          shotRow("rod-at-posts", "rod of 2 m turns at 5, 20, 40 rad/s between two posts", passedThePosts,
                  {5.0, 20.0, 40.0})};
}

}  // namespace carom::bench
