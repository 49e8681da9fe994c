#pragma once
// Swings that are small are damped (swinging.h), once a step. Internal to the simulation floor. Tested in
// tests/physics/friction/swing_test.cpp and tests/explore/ (the family `ice`).

#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/contacts/contact_assembly.h"
#include "engine/simulation/events/closed_islands.h"

namespace carom {

/// At the end of a step with these lasting contacts. What flies with all that it touches, and where no
/// friction holds it the sliding, is not damped.
void dampSwings(const LastingWorld& world, LastingContacts& contacts, const FlightPlanner& planner,
                const ClosedIslands& closed);

}  // namespace carom
