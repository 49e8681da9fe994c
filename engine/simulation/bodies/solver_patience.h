#pragma once
// Solved at once (standing_solver.h), a wall of thousands of bricks stands in a few steps. A heap of
// thousands in which contacts come and go is as far from converged after as before, or soon again, at many
// times the cost of a sweep: after some such steps it is swept alone for a while. Internal to the simulation
// floor. Tested in tests/engine/simulation/bodies/solver_patience_test.cpp.

#include <span>
#include <vector>

#include "engine/response/sweeps/contact_solver.h"
#include "engine/simulation/bodies/body.h"

namespace carom {

/// Of one island and step; what it learns, the island's bodies keep. Small islands never lose theirs.
class SolverPatience {
 public:
  SolverPatience(std::span<const ContactRow> rows, std::vector<Body>& bodies);

  bool isLost() const { return swept_alone_ > 0; }
  /// For a step in which it is lost.
  void waitAStep() { keep(in_vain_, swept_alone_ - 1); }
  /// From a solve that was to come to `enough_mps`: where sweeps did not, whether solving at once did.
  void learn(const SolverReport& report, double enough_mps);

 private:
  void keep(int in_vain, int swept_alone);

  std::span<const ContactRow> rows_;  ///< None of a small island.
  std::vector<Body>& bodies_;
  int in_vain_ = 0;      ///< How much more often it was not worth it than it was.
  int swept_alone_ = 0;  ///< Steps for which it is not tried again.
};

}  // namespace carom
