// The libraries that run experiments. Which peers there are was decided by tests/bench/CMakeLists.txt.

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/carom_simulation.h"

namespace carom::bench {

std::unique_ptr<physics::Simulation> startBullet(const physics::Experiment& experiment);
std::unique_ptr<physics::Simulation> startOde(const physics::Experiment& experiment);

std::vector<physics::Simulator> simulators() {
  std::vector<physics::Simulator> all{physics::kCarom};
#ifdef CAROM_BENCH_BULLET
  all.push_back({"Bullet", startBullet, false});
#endif
#ifdef CAROM_BENCH_ODE
  all.push_back({"ODE", startOde, false});
#endif
  return all;
}

}  // namespace carom::bench
