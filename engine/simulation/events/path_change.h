#pragma once
// How far solvers may lead paths from where momenta would take them. What is wedged between others parts from
// both when it is shot out sideways, at any speed; but standing still would have been nearer. Internal to the
// simulation floor. Tested in tests/engine/simulation/events/path_change_test.cpp and by
// tests/explore/cases/wedged-stack.json.

#include <span>

#include "engine/foundation/tolerances.h"
#include "engine/response/one_point/impulse.h"

namespace carom {

/// Of the collision speed: the fastest closing that a path keeps towards a gap in the window.
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
  return linear + (turns_freely ? v.angular.dot(body.inverse_tensor.inverse() * v.angular)
                                : v.angular.squaredNorm() / trace);
}

/// Whether the velocities of the paths are as near, in the measure of energy, to what they were `before` as
/// standing still would be, but for gaps that open.
inline bool staysNear(std::span<const ImpulseBody> before, std::span<const ImpulseBody> after) {
  double led_J = 0.0, stopped_J = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const ImpulseBody& body = before[i];
    const Velocity& led = after[i].velocity;
    led_J += twiceEnergy(body, {led.linear - body.velocity.linear, led.angular - body.velocity.angular});
    stopped_J += twiceEnergy(body, body.velocity);
    if (body.inverse_mass > 0.0) stopped_J += tolerance::kGapSpeed * tolerance::kGapSpeed / body.inverse_mass;
  }
  return led_J <= stopped_J;
}

}  // namespace carom
