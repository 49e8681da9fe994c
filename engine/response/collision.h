#pragma once
// A collision at one or more points, of two bodies or more, (paper §2.1 and §2.4) with restitution and
// Coulomb friction. At one point it is followed through (point_collision.h). At several: compression to rest
// with friction, then every compressed point leaves with e times its approach speed, friction acting on.
// Kinetic energy never grows: compression with friction only dissipates, and restitution is cut back where it
// would return more than was there. Few points are solved by Newton's method (newton_solver.h). Resistance to
// turning belongs to lasting contact: here it does not act. Tested in
// tests/engine/response/collision_test.cpp.

#include <span>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Changes the velocities of the bodies that `rows` (prepared, zero impulses) refer to. `restitution`: one a
/// row. `enough_mps`: what the solves may leave over of their conditions, at several points; what rounding
/// allows is less by far.
void collide(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, std::span<const double> restitution,
             double enough_mps = 0.0);

}  // namespace carom
