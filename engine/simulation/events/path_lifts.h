#pragma once
// What paths lift bodies by is energy that no impulse gave: a path that is led clear of a floor, or held,
// does not fall as far as weight has accelerated the momentum for. It comes out of the speeds at which those
// that were led together rise or fall, so that no step ends with more energy than impulses left it. What
// bodies in flight do to each other's paths lifts one by what it lowers the other, and costs nothing.
// Internal to the simulation floor. Tested in tests/engine/simulation/events/path_lifts_test.cpp.

#include <span>
#include <vector>

#include "engine/modes/islands.h"
#include "engine/simulation/bodies/flight_plan.h"

namespace carom {

class PathLifts {
 public:
  /// Nobody has been led in this substep.
  void begin(std::size_t bodies);
  /// The paths of these, if they move, were led together.
  void join(int a, int b, const std::vector<Body>& bodies);
  /// At the end of the substep, when bodies have their velocities and `lift` is whole.
  void pay(std::vector<Body>& bodies, std::span<const int> active, const FlightPlanner& planner);

 private:
  struct Account {
    double net_J = 0.0;     ///< All lifts.
    double raised_J = 0.0;  ///< Those above zero.
  };
  Islands together_;
  std::vector<Account> accounts_;  ///< By island.
};

}  // namespace carom
