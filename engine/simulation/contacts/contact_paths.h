#pragma once
// The paths of bodies in lasting contact (carried_path.h): where the impulses that hold them take them within
// the step. Internal to the simulation floor. Tested through tests/engine/simulation/ and tests/physics/.

#include "engine/simulation/contacts/contact_assembly.h"

namespace carom {

/// The path of a pressed body: the mean of the velocities before and after, which is exact for constant
/// friction, but never into a gap: the same contacts once more, as bounds on the path alone, so that
/// reopening a gap gives no energy. The rows come solved, and keep their impulses. Of some islands, by index.
void setContactPaths(const LastingWorld& world, std::span<const std::size_t> islands, StepCounters& counters,
                     LastingContacts& contacts);

}  // namespace carom
