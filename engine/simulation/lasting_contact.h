#pragma once
// Lasting contact (paper §2.4): bodies close together that approach slowly get gravity once per step and an
// impulse at every point of contact, solved together; their paths for the step follow. Faster approaches are
// left to the time of impact, which gives them their restitution. Internal to the simulation floor. Tested
// through tests/engine/simulation/ and tests/physics/.

#include <vector>

#include "engine/response/turning_resistance.h"
#include "engine/simulation/contact_rows.h"
#include "engine/simulation/flight_plan.h"

namespace carom {

/// What of a row differs between the solve of the momentum and that of the paths.
struct MomentumPart {
  Vec3 impulse;
  double lowest_speed = 0.0;
};

/// The contact rows of a step with where they came from; kept for the modes, and their memory for the next
/// step.
struct LastingContacts {
  std::vector<ContactRow> rows;
  std::vector<SourcedRow> sources;  ///< As long: the rows as they were before the solve, and where from.
  std::vector<ImpulseBody> bodies;  ///< One per body of the world, velocities after the solve.
  std::vector<char> touched;        ///< Bodies that some row pressed.
  std::vector<std::size_t> island_begin;  ///< Where each island's rows begin, and the end.
  std::vector<ImpulseBody> paths;         ///< The bodies with the mean velocities of their paths.
  std::vector<MomentumPart> momentum;     ///< Of the rows, while they are bounds on paths.
  std::vector<SourcedRow> unsorted;       ///< Scratch.
};

/// Wakes the resting islands that a moving body presses on; whether there were any.
bool wakePressed(std::vector<Body>& bodies, const LastingContacts& contacts);

/// Whether the pair is near enough, for its speed, to be solved as lasting contact in this step.
bool isLasting(const ShapePair& pair, double step_s);

/// Solves the step's lasting contacts and sets path and momentum of the bodies that they press. Bodies must
/// come with planned paths that start at the beginning of the step; resting ones do not give way.
void solveLastingContacts(std::vector<Body>& bodies, const std::vector<Shape>& shapes,
                          std::vector<ShapePair>& pairs, FlightPlanner& planner,
                          const WorldSettings& settings, StepCounters& counters, LastingContacts& contacts);

/// The load that a row is remembered by, and acts with, instead of what it took in the step.
void correctLoad(const SourcedRow& sourced, const RowLoad& load, double step_s,
                 std::vector<ShapePair>& pairs);

/// Makes a body that rested move again.
void wake(Body& body);
/// Wakes everything that came to rest together with a body.
void wakeIsland(std::vector<Body>& bodies, int island);

}  // namespace carom
