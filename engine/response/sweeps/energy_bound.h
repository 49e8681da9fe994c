#pragma once
// Impulses that together give energy where their bounds ask for none: what sweeps under a budget leave
// unconverged, or what is remembered of another arrangement of bodies. Tested in
// tests/engine/response/sweeps/energy_bound_test.cpp.

#include <span>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// The rows' impulses have been applied. With all of them scaled by s, the energy that they make beyond what
/// the bounds allow is s p + s^2 w / 2, p being their power on the speeds that missed the bounds before, w
/// twice the energy of what they make of the velocities. Where that is more than none at s = 1, they are
/// scaled to its least, which never is: then no bound above zero, no energy from nothing, whatever the
/// impulses. What has converged is left as it is, to the bit.
void takeBackGain(std::span<ContactRow> rows, std::span<ImpulseBody> bodies);

/// The same of the contacts of a step, in which other forces act, too: `before` are the bodies' velocities
/// ahead of all of these. What the contacts give is their impulses' power on the mean of the velocities
/// before and after. Where it is more than bounds above zero allow, they are scaled to where it is none.
void takeBackWork(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                  std::span<const Velocity> before);

}  // namespace carom
