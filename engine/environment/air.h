#pragma once
// Still or moving air. It presses on the windward side of bodies (drag.h); it carries none of their weight.
// Tested in tests/physics/water/terminal_velocity_test.cpp and tests/physics/water/stream_test.cpp.

#include "engine/foundation/frames.h"

namespace carom {

struct Air {
  double density_kgpm3 = 0.0;  ///< 0: vacuum.
  Vec3 wind = Vec3::Zero();    ///< m/s, world frame.
  double skin_friction = 0.0;  ///< Coefficient of the drag along flat faces; 0: none.
};

}  // namespace carom
