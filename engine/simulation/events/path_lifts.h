#pragma once
// Forces do work on a momentum on the way that it would go. A path that is led clear of a floor, raised for
// what turns, or held goes another way, and what the forces would not have done on that one is energy that
// nothing gave: weight has accelerated a momentum for a fall that its path did not make. It comes out of the
// motion of those whose paths were led together: out of the speeds at which they rise from what bears them or
// fall to it, then out of their tipping. So does what a contact that presses does as paths open it: it raises
// all that lies above (openingPower). What forces that way cannot change is kept, and who moves no other way
// pays nothing.
// What bodies do to each other's paths otherwise lifts one by what it lowers the other, and costs nothing.
// Internal to the simulation floor. Tested in tests/engine/simulation/events/path_lifts_test.cpp.

#include <span>
#include <vector>

#include "engine/modes/islands.h"
#include "engine/simulation/bodies/flight_plan.h"
#include "engine/simulation/contacts/pair_table.h"
#include "engine/simulation/events/closed_islands.h"

namespace carom {

/// What the forces on a body, of the environment and of lasting contacts, have done more on the way of its
/// momentum than they would have on its path, from where that began until `time_s`, J/kg: the virtual work of
/// going from one to the other, and of what opens. `velocity` and `position_m` are the momentum's and the
/// path's at that time.
double liftOfPath(const Body& body, const Velocity& velocity, const Vec3& position_m, double time_s);

/// Leaves this share of what forces along `way`, of length 1, can change of a body's motion.
void slowAlong(Body& body, double keeps, const Vec3& way);

/// Adds to the body's accounts, its lift and the sum of its places, what its path was until then.
void countPath(Body& body, const Velocity& velocity, const Vec3& position_m, double time_s);

class PathLifts {
 public:
  /// Nobody has been led in this substep.
  void begin(std::size_t bodies);
  /// The paths of these, if they move, were led together.
  void join(int a, int b, const std::vector<Body>& bodies);
  /// At the end of the substep, when bodies have their velocities and `lift` is whole. What only meets itself
  /// keeps its momentum: its islands pay (ClosedIslands::owe). `table`: whose contacts bear them.
  void pay(std::vector<Body>& bodies, std::span<const int> active, const PairTable& table,
           const FlightPlanner& planner, ClosedIslands& closed);

 private:
  struct Account {
    double net_J = 0.0;     ///< All lifts.
    double raised_J = 0.0;  ///< Those above zero.
    /// Of what does not give way: of what presses them, or else of what is nearest; zero: there is none.
    Vec3 normal_W = Vec3::Zero();
    double nearest_m = kInfinity;  ///< How near; 0: it presses.
    bool has_one_normal = true;
    void meet(const ShapePair& pair);
  };
  void findNormals(const std::vector<Body>& bodies, std::span<const int> active, const PairTable& table);
  Islands together_;
  std::vector<Account> accounts_;  ///< By island.
};

}  // namespace carom
