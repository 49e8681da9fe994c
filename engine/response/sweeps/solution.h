#pragma once
// What a solver has found so far, to return to.

#include <span>
#include <vector>

#include "engine/response/sweeps/contact_solver.h"

namespace carom {

/// Of rows and their bodies: impulses, torques, velocities.
class Solution {
 public:
  Solution(std::span<const ContactRow> rows, std::span<const ImpulseBody> bodies);
  void restore(std::span<ContactRow> rows, std::span<ImpulseBody> bodies) const;

 private:
  std::vector<Vec3> impulses_;
  std::vector<Vec3> torques_;
  std::vector<Velocity> velocities_;  // of both bodies of every row
};

}  // namespace carom
