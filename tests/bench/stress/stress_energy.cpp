// stress energy: SimBenchmark's two elastic scenes at their published steps.

#include <cstdio>

#include "tests/bench/stress/stress.h"
#include "tests/physics/sim_benchmark.h"

namespace carom::bench {
namespace {

bool report(const char* name, double step_s, physics::ElasticBalls scene, double seconds, double bar_J2) {
  scene.run(seconds);
  const bool met = scene.meanSquare() <= bar_J2 && scene.smallest_gap_m() > 0.0;
  std::printf(
      "%-12s dt %-6g %5.2f s  mean (E - E0)^2 %.3g J^2 (bar %g)  worst %.3g J  stopped %ld  gap %.2g m  %s\n",
      name, step_s, seconds, scene.meanSquare(), bar_J2, scene.worst_J(), scene.held(),
      scene.smallest_gap_m(), met ? "met" : "MISSED");
  return met;
}

}  // namespace

bool runEnergy(const EnergyRun& run) {
  bool met = true;
  for (double step_s : {0.01, 0.001}) {
    met &= report("bouncing", step_s, physics::ElasticBalls::bouncing(step_s), 20.0 * run.share, 1e-6);
    met &= report("elastic 666", step_s, physics::ElasticBalls::cube(step_s, 1), 10.0 * run.share, 1e-3);
  }
  return met;
}

}  // namespace carom::bench
