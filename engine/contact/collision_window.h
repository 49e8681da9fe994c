#pragma once
// The collision window of paper §2.3, fig. 7: two distances epsilon1 < epsilon2. Between them a collision is
// solved directly, without root finding; below epsilon1 no pair ever gets. DEVIATES: what will not bounce is
// struck at the landing gap, where it is then held, not anywhere in the window. Tested in
// tests/engine/contact/collision_window_test.cpp.

#include <algorithm>

#include "engine/foundation/tolerances.h"
#include "engine/solid/solid.h"

namespace carom {

/// All in metres; 0 < floor < rest < landing < ceiling.
struct CollisionWindow {
  double floor = 0.0;     ///< epsilon1.
  double rest = 0.0;      ///< The gap at which lasting contact is held.
  double landing = 0.0;   ///< The gap at which a time of impact aims.
  double ceiling = 0.0;   ///< epsilon2.
  double manifold = 0.0;  ///< The distance k of §2.4.
};

/// Of a pair whose smaller body that can move is so wide (Solid::width). What cannot move does not count: a
/// floor of tiles is one floor, however small the tiles are.
inline CollisionWindow collisionWindow(double width_m) {
  const double scale = std::min(width_m, tolerance::kWindowLargestScale);
  return {scale * tolerance::kWindowFloor, scale * tolerance::kRestGap, scale * tolerance::kLandingGap,
          scale * tolerance::kWindowCeiling, scale * tolerance::kManifoldHeight};
}
/// Of two bodies of one part, both of which can move.
inline CollisionWindow collisionWindow(const ConvexPart& a, const ConvexPart& b) {
  return collisionWindow(std::min(a.width(), b.width()));
}

}  // namespace carom
