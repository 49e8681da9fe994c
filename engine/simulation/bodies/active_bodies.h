#pragma once
// The bodies that a step looks at: those that move, and those that came to rest in the step before, for which
// what is kept of them is brought to rest once. All the others are in no loop. Bodies that came to rest
// together are linked in a ring, so that they wake together without a search. Internal to the simulation
// floor. Tested in tests/engine/simulation/bodies/active_bodies_test.cpp.

#include <span>
#include <vector>

#include "engine/simulation/bodies/body.h"

namespace carom {

class ActiveBodies {
 public:
  /// A body that has come into the world, the last.
  void add(int body) { active_.push_back(body); }
  /// Bodies that have not moved in the whole last step are not active any more.
  void beginStep(std::vector<Body>& bodies);
  /// Wakes what came to rest together with a body; those bodies are active from now on. Returns them.
  std::span<const int> wakeIsland(std::vector<Body>& bodies, int body);

  /// Ascending.
  std::span<const int> list() const { return active_; }

 private:
  std::vector<int> active_;
  std::vector<int> woken_;  ///< By the last call.
};

}  // namespace carom
