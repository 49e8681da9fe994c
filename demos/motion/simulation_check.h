#pragma once
// The engine's guarantee, looked at from outside after a step: numbers stay finite and no gap closes.
// Tested in tests/demos/motion/simulation_check_test.cpp.

#include <limits>
#include <span>
#include <string>

#include "engine/simulation/world.h"

namespace carom::demos {

/// What a run came across, for its last line.
struct RunFacts {
  double smallest_gap_m = std::numeric_limits<double>::infinity();
  long long events = 0;
  long long stopped_bodies = 0;
  double work_J = 0.0;            ///< Of kinematic bodies and loads.
  double kinematic_late_s = 0.0;  ///< See Audit.
  long long iteration_limits = 0;
};

/// Adds a step's audit to the facts; throws SimulationInvalid when a gap has closed or a state is not finite,
/// naming the step and, for a state, the body.
void checkStep(const World& world, const Audit& audit, std::span<const std::string> names, RunFacts& facts);

}  // namespace carom::demos
