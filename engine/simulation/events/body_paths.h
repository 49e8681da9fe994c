#pragma once
// What events make of the paths of single bodies within a step: each path ends where an event takes its body
// up, and begins there anew. Whoever changes a path says so to the searches of its pairs (event_loop.cpp).
// Internal to the simulation floor. Tested in tests/engine/simulation/events/body_paths_test.cpp and
// through tests/engine/simulation/ and tests/physics/.

#include <vector>

#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/bodies/step_paths.h"
#include "engine/simulation/contacts/contact_assembly.h"

namespace carom {

class BodyPaths {
 public:
  /// `ended`: told of the paths that events end, unless null.
  BodyPaths(const LastingWorld& world, const FlightPlanner& planner, StepCounters& counters, StepPaths* ended)
      : bodies_(world.bodies),
        table_(world.table),
        planner_(planner),
        settings_(world.settings),
        counters_(counters),
        ended_(ended) {}

  /// Ends a body's path at `time_s`, from where it must be given another: what tumbles would not go on as
  /// before.
  void bring(int index, double time_s);

  /// From where its path begins to the end of the step: in flight.
  void fly(int index);
  /// In flight, on a straight path to where that leads.
  void flyStraight(int index);
  /// By contacts, to the velocities `end`; the path bends as the momentum does, or is straight.
  void carryTo(int index, const Velocity& end, bool bends);
  /// By contacts, to the velocities `end`, straight on at the mean velocity that its path had.
  void keepPath(int index, const Velocity& end, const Velocity& mean);
  /// Its momentum goes to the velocities `end`, but the body, which was held, does not move.
  void driveHeld(int index, const Velocity& end);

  /// On at this mean velocity, without an impulse; where contacts lead it, the path may bend.
  void lead(int index, const Velocity& mean, bool bends);
  /// Of one of those that have been led together, once all are: what the forces of its contacts do on its
  /// path where that opens them (openingPower).
  void findOpening(int index);
  /// Straight on at half the speed.
  void halve(int index);
  /// Not at all. Its momentum goes on, and so do the forces of its contacts, which others have the opposites
  /// of: they have just been solved together, and the next step solves them again.
  void hold(int index);

  /// Stops a kinematic body at `time_s` for the rest of the step. Whether it was on its way.
  bool stopDriven(int index, double time_s);
  /// Brings a kinematic body to the next piece of its path.
  void beginNextPiece(int index);
  /// The work of the forces that act between a kinematic body and others from `time_s` on, counted, or taken
  /// back where they end (`sign`).
  void countForcesOf(int index, double time_s, double sign);

 private:
  /// Of a body from another's `path.start_s` to the end of the step, in the mean.
  Velocity meanOfPath(const Body& body, double time_s) const;
  Velocity meanOfMomentum(const Body& body, double time_s) const;
  double restOf(const Body& body) const { return settings_.step_s - body.path.start_s; }
  void stop(int index);
  void drive(Body& body, const Velocity& end);

  std::vector<Body>& bodies_;
  const PairTable& table_;
  const FlightPlanner& planner_;
  const WorldSettings& settings_;
  StepCounters& counters_;
  StepPaths* ended_;
};

}  // namespace carom
