#pragma once
// Holds the states of a world, step after step, against all oracles of this folder. It is told the states, so
// that a test can plant a fault in them. Tested in tests/explore/watch/world_judge_test.cpp.

#include "tests/explore/watch/apart_watch.h"
#include "tests/explore/watch/flight_watch.h"
#include "tests/explore/watch/glide_watch.h"
#include "tests/explore/watch/leap_watch.h"
#include "tests/explore/watch/momentum_watch.h"
#include "tests/explore/watch/moved_watch.h"

namespace carom::explore {

/// What a run took, for totals.
struct TrialTotals {
  long steps = 0;
  long body_steps = 0;  ///< Of bodies that can move.
  long stopped = 0;
  long queries = 0;
  long events = 0;
  double worst_gain = 0.0;    ///< Energy, in units of its tolerance.
  double most_events = 0.0;   ///< Of a step, per body that can move.
  double most_queries = 0.0;  ///< Of a step, per body that can move.
  int refused = 0;
};

class WorldJudge {
 public:
  /// Both must outlive it; `world` has started and not been stepped.
  WorldJudge(const demos::Scene& scene, const World& world);
  WorldJudge(const WorldJudge&) = delete;
  WorldJudge& operator=(const WorldJudge&) = delete;

  /// After step number `step`, from 1 on. False when nothing more can be said: a state is not finite.
  bool look(std::span<const BodyState> states, const StepCounters& counters, int step);
  /// Of every step of a world with loads, before `look`: where bodies have been within it.
  void lookAlong(const StatesWithin& within) { loads_.after(within); }
  /// At an instant within that step, before `look`.
  void lookBetween(std::span<const BodyState> states, int step);
  /// At the end of the run.
  void conclude(int step);

  Findings& findings() { return findings_; }
  TrialTotals& totals() { return totals_; }

 private:
  void checkMasses();
  void lookForOverlap(std::span<const BodyState> states, const char* kind, int step);
  void count(const StepCounters& counters, int step);
  Real workOfStep(const StepCounters& counters, int step);

  const demos::Scene& scene_;
  const World& world_;
  std::vector<OwnBody> bodies_;
  Mechanics start_;
  bool keeps_energy_ = false;  ///< Nothing but gravity can add to it.
  bool knows_work_ = false;    ///< Nothing does any but forces that are constant in the world.
  EnergyWatch energy_;
  FlightWatch flight_;
  GlideWatch glide_;
  LeapWatch leap_;
  Real kinetic_before_J_ = 0;
  MovedWatch moved_;
  LoadWatch loads_;
  MomentumWatch momentum_;
  Real pushed_J_ = 0;  ///< By loads, before the step.
  Real told_J_ = 0;    ///< The engine's own account of that.
  ApartWatch apart_;
  Findings findings_;
  TrialTotals totals_;
};

}  // namespace carom::explore
