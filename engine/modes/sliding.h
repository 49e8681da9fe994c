#pragma once
// Sliding mode (paper §2.4: the goal of finding all points of contact): lasting contact with motion along it.
// Tested in tests/engine/modes/sliding_test.cpp.

#include <span>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// How fast a contact slides, m/s; 0 when it does not press.
double slidingSpeed(const ContactRow& row, std::span<const ImpulseBody> bodies);
/// Whether a contact slides rather than rolls, tips or sticks.
bool slides(const ContactRow& row, std::span<const ImpulseBody> bodies);

}  // namespace carom
