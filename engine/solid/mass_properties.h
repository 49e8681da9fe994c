#pragma once
// Exact mass properties of a convex core grown by a radius: polyhedra, balls, capsules, and rounded polyhedra
// through one formula. The grown solid is cut into the core, a slab on each face, a cylinder wedge along each
// edge and a ball sector at each vertex (Steiner's decomposition); each has its volume and its first and
// second moments in closed form. Tested against closed forms in
// tests/engine/solid/mass_properties_test.cpp.

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

/// Of all points within `radius_m` of the core: a point makes a ball, a segment a capsule, a polyhedron with
/// radius 0 is itself. Zero mass where there is no volume. Cost: linear in the features.
MassProperties roundedMass(const ConvexPolyhedron& core, double radius_m);

/// Of the polyhedron alone.
MassProperties polyhedronMass(const ConvexPolyhedron& polyhedron);

}  // namespace carom
