#pragma once
// A settled heap in plain numbers, and how long each library takes to step it: all bodies begin at rest where
// ours left them, nothing is allowed to sleep. Nobody knows at first what presses how hard, and a heap goes
// on falling about for up to six seconds, so everybody has eight to settle again before time is taken. Each
// library is one file, as with the queries (library.h).

#include <array>
#include <chrono>
#include <vector>

#include "tests/bench/peers/library.h"

namespace carom {
class World;
}

namespace carom::bench {

struct PlainBody {
  int solid = 0;
  PlainPose X_WB;
  bool is_static = false;
  std::array<double, 3> velocity{};  ///< m/s.
};

struct PlainSolid {
  Hull hull;
  std::array<double, 3> box_size{0, 0, 0};  ///< Of a box; zero for other hulls.
  double mass = 0.0;                        ///< kg.
  std::array<double, 6> inertia{};          ///< kg m^2 about the origin: xx, yy, zz, xy, xz, yz.
};

struct PlainPile {
  std::vector<PlainSolid> solids;
  std::vector<PlainBody> bodies;
  double friction = 0.0;
  double step_s = 1.0 / 60.0;
  double gravity = 9.81;  ///< Along -z.
  bool sleeps = false;    ///< What lies still is put to sleep; then all steps are timed, from the first.
};

inline constexpr double kSettling_s = 8.0;

/// Milliseconds of each of `steps` calls, after as many as the heap has to settle again unless it sleeps.
template <typename Step>
std::vector<double> settledSteps(const PlainPile& pile, int steps, const Step& step) {
  for (double t = 0.0; t < kSettling_s && !pile.sleeps; t += pile.step_s) step();
  std::vector<double> ms;
  for (int i = 0; i < steps; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    step();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return ms;
}

/// The bodies of a world as they stand; all of one material.
PlainPile plainPile(const World& world);

struct PileStepper {
  const char* name;
  std::vector<double> (*stepTimes_ms)(const PlainPile& pile, int steps);
};
/// Ours first, by one thread and by two, then the peers that were there when this was built.
std::vector<PileStepper> pileSteppers();

}  // namespace carom::bench
