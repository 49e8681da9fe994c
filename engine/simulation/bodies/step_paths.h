#pragma once
// The bodies' paths through the last step, of a world that keeps them (World::keepPaths): where each body was
// at any instant of it. They are the very paths that the search for times of impact has proven to be apart,
// from event to event and from substep to substep, so that a picture between two steps shows no overlap
// either. Internal to the simulation floor. Tested in tests/engine/simulation/bodies/step_paths_test.cpp.

#include <vector>

#include "engine/simulation/bodies/body.h"

namespace carom {

class StepPaths {
 public:
  /// Forgets the step before; this one is made in so many equal substeps.
  void beginStep(std::size_t bodies, int substeps, double substep_s);
  void beginSubstep(int substep) { substep_ = substep; }
  /// The body of that index has moved so up to `time_s` of the substep, and may from then on move otherwise.
  void add(std::size_t index, const StepMotion& motion, double time_s);

  /// Its pose and velocities `share` of the way through the step. A body that no piece tells of then lies
  /// still: where its next piece begins or, if there is none, as `at_end`.
  BodyState stateAt(std::size_t index, const Inertia& inertia, double share, const BodyState& at_end) const;

 private:
  struct Piece {
    int substep = 0;
    double end_s = 0.0;  ///< Of the substep, like the motion's own times.
    StepMotion motion;
  };
  std::vector<std::vector<Piece>> pieces_;  ///< By body, in their order.
  std::vector<std::size_t> told_of_;        ///< Bodies with pieces.
  int substeps_ = 1;
  double substep_s_ = 0.0;
  int substep_ = 0;  ///< The present one.
};

}  // namespace carom
