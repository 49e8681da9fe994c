#pragma once
// The approach test of paper §2.2. DEVIATES: the paper calls v_rel < 0 separating and > 0 colliding without
// fixing an order; here the normal points from A to B and u = n . (v_B - v_A): negative approaches, positive
// separates. Tested in tests/engine/contact/approach_test.cpp.

#include "engine/motion/rigid_body.h"

namespace carom {

/// The velocity of B relative to A at world point p.
inline Vec3 relativeVelocity(const Velocity& a, const Vec3& center_a, const Velocity& b, const Vec3& center_b,
                             const Vec3& p_W) {
  return b.at(p_W - center_b) - a.at(p_W - center_a);
}

/// u, m/s: a collision happens only when it is negative.
inline double separatingSpeed(const Velocity& a, const Vec3& center_a, const Velocity& b,
                              const Vec3& center_b, const Vec3& p_W, const Vec3& n_W) {
  return n_W.dot(relativeVelocity(a, center_a, b, center_b, p_W));
}

}  // namespace carom
