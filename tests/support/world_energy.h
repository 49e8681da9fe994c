#pragma once
// The energy of a world, kinetic and potential.

#include "engine/simulation/world.h"

namespace carom {

inline double energyOf(const World& world) {
  const Audit now = world.audit();
  return now.kinetic_energy_J + now.potential_energy_J;
}

}  // namespace carom
