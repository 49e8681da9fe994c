#pragma once
// One pass over contact rows from the supports upwards. Every body is brought to the bounds of all its rows
// with bodies below it, which stay as they are: so a tower is opened from its foot to its top in one pass,
// where sweeps that move both bodies of a row carry a correction up by one body each. What wedges bodies from
// above as well stays unsolved. For velocities that are paths only: the impulses do not act back. Tested in
// tests/engine/response/sweeps/ordered_pass_test.cpp.

#include <span>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Raises the separating speeds of the rows to their `lowest_speed`, without friction, the rows' impulses
/// being as they were. `up`: away from the supports, of any length; null: nothing is above anything else, and
/// nothing is done.
void passUpwards(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies, const Vec3& up);

}  // namespace carom
