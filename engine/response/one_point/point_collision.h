#pragma once
// The collision of two bodies at one point, with friction (paper §3: friction in every collision), followed
// through the collision: as the normal impulse grows, friction opposes the slip there is at that instant, so
// that a slip may stop, hold, or turn round within one collision (Routh 1860; Mirtich 1996, ch. 3). It ends
// by energetic restitution (Stronge 1990): when the normal force has given back e^2 of the work that it took.
// Kinetic energy never grows, whatever the friction (where restitution by speeds would make it grow: Kane's
// pendulum). Tested in tests/engine/response/one_point/point_collision_test.cpp.

#include "engine/response/one_point/impulse.h"

namespace carom {

struct Friction {
  double static_coefficient = 0.0;
  double dynamic_coefficient = 0.0;
};

/// In a frame of the normal and two tangents.
struct PointCollision {
  Mat3 response = Mat3::Identity();  ///< K, 1/kg, symmetric and positive definite.
  Vec3 velocity = Vec3::Zero();      ///< (separating, t1, t2) of B relative to A before, m/s.
  Friction friction;
  double restitution = 0.0;  ///< 0 to 1.
};

/// The impulse on B, N s, in that frame; zero when the point does not approach.
Vec3 pointCollisionImpulse(const PointCollision& collision);

}  // namespace carom
