#pragma once
// Lasting contact (paper §2.4): bodies close together that approach slowly get gravity once per step and an
// impulse at every point of contact, solved together; their paths for the step follow. Faster approaches are
// left to the time of impact, which gives them their restitution. DEVIATES: landings of many bodies in one
// step, each an event in the paper, are solved here as well. Internal to the simulation floor. Tested through
// tests/engine/simulation/ and tests/physics/.

#include <vector>

#include "engine/response/sweeps/turning_resistance.h"
#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/contacts/contact_assembly.h"

namespace carom {

/// Wakes the resting islands that a moving body presses on; whether there were any.
bool wakePressed(const LastingWorld& world, const LastingContacts& contacts);

/// Solves the step's lasting contacts and sets path and momentum of the bodies that they press. Bodies must
/// come with planned paths that start at the beginning of the step; resting ones do not give way.
void solveLastingContacts(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
                          LastingContacts& contacts);

/// The same of pairs that were foreseen on the paths of what has been solved.
std::vector<int> crowdedLandings(std::span<const int> pairs, const LastingWorld& world,
                                 LastingContacts& contacts);
/// Solves them with their islands. Returns the moving bodies of these, whose paths are new.
std::vector<int> solveLandings(std::span<const int> pairs, const LastingWorld& world,
                               const FlightPlanner& planner, StepCounters& counters,
                               LastingContacts& contacts);

/// The load that a row of `contacts` is remembered by, and acts with, instead of what it took in the step.
void correctLoad(const LastingContacts& contacts, std::size_t row, const RowLoad& load, double step_s,
                 std::vector<ShapePair>& pairs);

}  // namespace carom
