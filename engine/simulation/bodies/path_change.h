#pragma once
// How far solvers may lead paths from where momenta would take them. What is wedged between others parts from
// both when it is shot out sideways, at any speed; but standing still would have been nearer. Internal to the
// simulation floor. Tested in tests/engine/simulation/bodies/path_change_test.cpp and by
// tests/explore/cases (wedged-stack, raised-for-turning).

#include <span>

#include "engine/foundation/tolerances.h"
#include "engine/response/one_point/impulse.h"

namespace carom {

/// Of the collision speed: the fastest closing that a path, or a momentum, keeps towards a gap in the window.
inline constexpr double kSlowShare = 0.5;

/// Twice the energy of a body at these velocities, J; 0 for one that cannot move. What turns about one axis
/// alone has a tensor of rank one.
inline double twiceEnergy(const ImpulseBody& body, const Velocity& v) {
  if (body.inverse_mass == 0.0) return 0.0;
  const double linear = v.linear.squaredNorm() / body.inverse_mass;
  const double trace = body.inverse_tensor.trace();
  if (!(trace > 0.0)) return linear;
  constexpr double kRankOne = 1e-12;
  const bool turns_freely = body.inverse_tensor.determinant() > kRankOne * trace * trace * trace;
  return linear + (turns_freely ? dot(v.angular, body.inverse_tensor.inverse() * v.angular)
                                : v.angular.squaredNorm() / trace);
}

/// How far paths are led, body by body, in the measure of energy.
struct PathChange {
  double led_J = 0.0;
  double stopped_J = 0.0;  ///< As far as standing still would be, but for gaps that open.

  void add(const ImpulseBody& body, const Velocity& before, const Velocity& after) {
    led_J += twiceEnergy(body, {after.linear - before.linear, after.angular - before.angular});
    stopped_J += twiceEnergy(body, before);
    if (body.inverse_mass > 0.0) stopped_J += tolerance::kGapSpeed * tolerance::kGapSpeed / body.inverse_mass;
  }
  bool staysNear() const { return led_J <= stopped_J; }
};

/// Whether the velocities of the paths are as near to what they were `before` as standing still would be.
inline bool staysNear(std::span<const ImpulseBody> before, std::span<const ImpulseBody> after) {
  PathChange change;
  for (std::size_t i = 0; i < before.size(); ++i)
    change.add(before[i], before[i].velocity, after[i].velocity);
  return change.staysNear();
}

}  // namespace carom
