#pragma once
// Nonsmooth nonlinear conjugate gradients on the sweeps of contact_solver.h, there and back at a time
// (Silcowitz, Niebe, Erleben 2010): several times fewer sweeps where bodies stand on each other. Tested in
// tests/engine/response/conjugate_sweeps_test.cpp.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/response/sweeps/shared_sweeps.h"

namespace carom {

/// The bodies that rows refer to, each once, as indices: of a world, those of one island.
std::vector<std::size_t> involvedBodies(std::span<const ContactRow> rows, std::span<ImpulseBody> bodies);

/// Rows that are solved several times: what is found of them once is kept.
class ConjugateSweeps {
 public:
  ConjugateSweeps(std::span<ContactRow> rows, std::span<ImpulseBody> bodies, Crew* crew = nullptr);

  /// As solveContacts, from the impulses and velocities as they are now.
  SolverReport solve(const SolverSettings& settings);

 private:
  struct Iterate {  // impulses and the velocities they give: a point, or a direction, of the search
    std::vector<Vec3> impulses;
    std::vector<Vec3> torques;  // none where no row resists turning
    std::vector<Velocity> velocities;
  };
  void begin(bool friction);
  double squaredStep();
  void continueAlong(double share);
  template <typename Work>
  void inBlocks(std::size_t count, const Work& work);

  std::span<ContactRow> rows_;
  std::span<ImpulseBody> bodies_;
  Crew* crew_;
  std::vector<std::size_t> involved_;
  SharedSweeps sweeps_;
  bool turning_ = false;
  std::vector<double> squares_;  // of blocks of rows
  Iterate before_, direction_;
};

SolverReport solveContactsFinely(std::span<ContactRow> rows, std::span<ImpulseBody> bodies,
                                 const SolverSettings& settings);

}  // namespace carom
