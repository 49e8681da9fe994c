#pragma once
// Advancing to the next time of impact (paper §1 and §2.3), pair by pair (DEVIATES: the paper merges the
// collisions of all bodies to the world's first): an event brings only the bodies that its impulses reach to
// its time and gives them new paths from there; only their pairs are searched anew, and every search only as
// far as events come. The others wait on their own paths. What will not bounce and would come down in a crowd
// is handed to the lasting contacts before anything moves. Where only paths meet, and momenta do not bring
// the bodies together fast, is no event: the paths are led apart (path_clearing.h), and no impulse acts. A
// body that has had its budget of either is held at its last safe time: accuracy is lost and counted, the gap
// is not. Internal to the simulation floor. Tested in tests/physics/piles/pile_test.cpp and through
// tests/engine/simulation/.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/bodies/phase_clock.h"
#include "engine/simulation/bodies/step_paths.h"
#include "engine/simulation/bodies/step_view.h"
#include "engine/simulation/contacts/lasting_contact.h"
#include "engine/simulation/events/closed_islands.h"
#include "engine/simulation/events/contact_cluster.h"
#include "engine/simulation/events/impact_searches.h"
#include "engine/simulation/events/path_clearing.h"
#include "engine/simulation/events/path_lifts.h"

namespace carom {

/// Who is told of a step, each unless null.
struct StepWatchers {
  PhaseClock* clock = nullptr;  ///< Of the step's phases.
  StepView* view = nullptr;     ///< Of the collisions.
  StepPaths* paths = nullptr;   ///< Of the paths that events have ended.
};

/// Kept from step to step for its room, and through a step for what its substeps share.
struct EventMemory {
  SearchMemory searches;
  ClusterMemory cluster;
  PathClearing clearing;
  PathLifts lifts;
  ClosedIslands closed;
};

/// Solves the landings of these pairs (ShapePair::landing), or of some of them, with the step's lasting
/// contacts, and lists the bodies that have new paths from the beginning of the step. None: what rested has
/// been woken, and the step must be planned anew.
using LandingSolver = std::function<std::optional<std::vector<int>>(std::span<const int>)>;

/// Carries all bodies to the end of the step; every pair keeps its gap at or above the window's floor (or
/// where it began, if lower) throughout. The bodies' paths then end at `X_end`. Whether it could; if not, the
/// step must be planned anew.
bool runEvents(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters,
               const StepWatchers& watchers, EventMemory& memory, const LandingSolver& solve_landings);

}  // namespace carom
