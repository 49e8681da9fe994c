#pragma once
// The approach test of paper §2.2. DEVIATES: the paper calls v_rel < 0 separating and > 0 colliding without
// fixing an order; here the normal points from A to B and u = n . (v_B - v_A): negative approaches, positive
// separates. Tested in tests/engine/contact/approach_test.cpp.

#include <algorithm>

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
  return dot(n_W, relativeVelocity(a, center_a, b, center_b, p_W));
}

/// How a part moves, and how far from its body's centre it reaches.
struct MovingReach {
  Velocity velocity;
  double reach_m = 0.0;
};

/// By how much turning can close the gap between two parts within `dt_s`, m: their points go in circles, at
/// most from one end to the other, and what slides along one that turns leaves its surface.
inline double mostClosing(const MovingReach& a, const MovingReach& b, double dt_s) {
  const double slide_m = dt_s * (b.velocity.linear - a.velocity.linear).norm();
  const auto closing = [&](const MovingReach& part) {
    const double angle = dt_s * part.velocity.angular.norm();
    return part.reach_m * std::min(0.5 * angle * angle, 2.0) + slide_m * std::min(angle, 1.0);
  };
  return closing(a) + closing(b);
}

}  // namespace carom
