#pragma once
// Exact mass properties of a polyhedron by integrating over its faces (divergence theorem), and of ball and
// capsule in closed form. Tested against closed forms in tests/engine/solid/mass_properties_test.cpp.

#include "engine/solid/convex_polyhedron.h"

namespace carom {

/// Mass, centre of mass and inertia about it for unit density (so mass equals volume, in m^3 and m^5).
struct MassProperties {
  double mass = 0.0;
  Vec3 center = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< About `center`, axes of the frame the solid is given in.

  /// The properties of two disjoint parts together (parallel-axis theorem).
  static MassProperties combined(const MassProperties& a, const MassProperties& b);
};

MassProperties polyhedronMass(const ConvexPolyhedron& polyhedron);
MassProperties ballMass(const Vec3& center, double radius_m);
/// A cylinder between a and b with half-ball caps.
MassProperties capsuleMass(const Vec3& a, const Vec3& b, double radius_m);

}  // namespace carom
