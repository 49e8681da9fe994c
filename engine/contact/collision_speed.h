#pragma once
// The speed that tells a collision from lasting contact. What gravity, or a load, gives a body that falls
// through the window, or within a step: slower approaches are lasting contact. By and by not so where next to
// nothing is lost in a bounce, which then goes on for ever: at e = 1 only bounces shorter than a fraction of
// a step are left out. Still less between bodies that both fall: nothing brings them together again. A trace
// of it always remains, or the rounding of a finished collision would be taken for another. A bounce that
// would last longer than a step, 2 e v / g, is one, however slow. Tested in
// tests/engine/contact/collision_speed_test.cpp.

#include <algorithm>
#include <cmath>

#include "engine/contact/collision_window.h"

namespace carom {

inline constexpr double kLeastGravity = 0.01;          // m/s^2: 6 mm/s for parts a metre wide
inline constexpr double kShortestBounce = 1.0 / 32.0;  // half a bounce, in steps
inline constexpr double kNoticedBounce = 1.0;          // steps: a bounce that would last longer is one
inline constexpr double kFallingShare = 0.5;
inline constexpr double kStepsOfGravity = 1.5;  // a body on others may fall for a step; half of one is margin

/// How two bodies come together.
struct Approach {
  CollisionWindow window;
  double restitution = 0.0;
  double pull_mps2 = 0.0;  ///< What pushes them together: gravity, or loads.
  bool both_fall = false;  ///< Nothing holds either.
  double step_s = 0.0;
};

/// m/s.
inline double collisionSpeed(const Approach& approach) {
  const double step_s = approach.step_s, e = approach.restitution;
  const auto given = [&](double gravity) {
    return std::max(std::sqrt(2.0 * gravity * approach.window.ceiling), kStepsOfGravity * gravity * step_s);
  };
  const double gravity = std::max(approach.pull_mps2, kLeastGravity);
  if (e == 0.0) return given(gravity);
  if (approach.both_fall) return std::max(kFallingShare * (1.0 - e) * given(gravity), given(kLeastGravity));
  const double step_speed = gravity * step_s;
  const double share = std::min((1.0 - e) / (1.0 - tolerance::kNearlyElastic), 1.0);
  const double noticed = std::min(share * given(gravity), kNoticedBounce * step_speed / (2.0 * e));
  return std::max({noticed, kShortestBounce * step_speed, given(kLeastGravity)});
}

}  // namespace carom
