#pragma once
// The least displacements, in the sum of their squares, by which bodies open the gaps between them:
//   minimise 1/2 sum |d_i|^2  subject to  n_k . (d_b - d_a) >= opening_k,
// solved by its dual, whose unknowns are the forces that would do it, all of them >= 0. Every body gives way
// alike, but along its free axes only, and what one presses on is pressed by it: no order of bodies or rows
// enters. Tested in tests/engine/simulation/least_displacements_test.cpp.

#include <span>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom {

/// Two bodies are to part along `n_W` by `opening_m`; by a negative one they may approach each other. A body
/// of index -1 does not give way.
struct Opening {
  int a = -1;
  int b = -1;
  Vec3 n_W = Vec3::UnitZ();  ///< Unit, from A to B.
  double opening_m = 0.0;
};

struct LeastDisplacements {
  std::vector<Vec3> displacement_W;  ///< One a body.
  std::vector<double>
      missing_m;     ///< One an opening: what of it is not done. Positive where there is no room.
  int products = 0;  ///< With the matrix of the openings: what the solve cost.
};

/// `free_axes` has one a body: 1 along the world's axes that it may be displaced along, else 0. Where
/// openings contradict each other the sum of the squares of what is missing is least. No displacement is
/// other than exactly zero where no opening > 0 asks for it, through others or directly.
LeastDisplacements leastDisplacements(std::span<const Opening> openings, std::span<const Vec3> free_axes);

}  // namespace carom
