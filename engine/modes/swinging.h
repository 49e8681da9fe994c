#pragma once
// What can keep an island from its rest (resting.h) for ever: a body on two or three points of contact is a
// pendulum, and neither Coulomb's friction nor restitution takes energy from what rolls to and fro on them.
// In solids that give, small swings die within seconds. Here they are damped as by dry friction, the more the
// smaller they are, so that they end where the forces balance. What goes on without turning round, however
// slowly, is not damped. DEVIATES: the paper has no such mode. Tested in tests/engine/modes/swinging_test.cpp
// and tests/physics/friction/swing_test.cpp.

#include "engine/motion/rigid_body.h"

namespace carom {

/// Follows a body in lasting contact from step to step.
class SwingWatch {
 public:
  /// After a step of `step_s` seconds without a collision: the velocity at its end of a body whose furthest
  /// point is `radius_m` from its centre of mass, and how high its kinetic energy would lift it against
  /// gravity.
  void follow(const Velocity& velocity, double radius_m, double rise_m, double step_s);
  /// It was struck, or left its contacts.
  void forget() { *this = {}; }
  /// The share of its velocity that the body keeps over the next such step: 1 unless it swings.
  double keeps(double step_s) const;

 private:
  Velocity fastest_;                 ///< Since it turned round last.
  double relative_amplitude_ = 0.0;  ///< Its rise, as a share of that of the largest swing that is small.
  double since_s_ = 0.0;             ///< Time since it turned round last.
  double half_s_ = 0.0;  ///< Time between its last two turns: half a swing, once it has turned twice.
  int turns_ = 0;
};

}  // namespace carom
