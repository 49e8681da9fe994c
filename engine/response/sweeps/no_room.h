#pragma once
// Whether bodies that nothing can move (of infinite mass, but on their way) leave the others no room: rows
// that no velocities meet. Sweeps then go on for ever, and their impulses grow without bound. Tested in
// tests/engine/response/sweeps/no_room_test.cpp.

#include <vector>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Of bodies on their way that leave others no room those that push most, by index; none where there is room.
/// When these stop there may be room, or others that push. The rows have been swept, with or without
/// `friction`, and speeds still miss their bounds. Of impulses l in the rows' cones, b being the power of
/// their normal parts on the misses that there were before and w twice the energy of what they make of
/// velocities at rest, no velocities that meet the rows are nearer, in the measure of energy, than b /
/// sqrt(w) (weak duality: Boyd and Vandenberghe 2004, 5.2; with friction: nearer by impulses that hold every
/// point that presses). There is no room where that is so far that bodies would have to give way many times
/// as fast as they are pushed, and most of b is the push. The l are those that further sweeps would add:
/// where there is no room these press, and move nothing.
std::vector<int> leavingNoRoom(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies,
                               bool friction);

}  // namespace carom
