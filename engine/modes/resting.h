#pragma once
// Resting mode (paper §2.5). An island that has lain still for a while rests when (1) the effective force on
// each of its bodies that stand on level contacts passes through the body's support polygon, and (2) the
// contacts can balance gravity within their friction cones, as far as places of contact are known: gaps are
// held in a band (DEVIATES: the paper knows the places exactly). DEVIATES: the paper asks only for (1) and
// low kinetic energy, which would freeze a box on a steep incline. (2) is asked of the contact solver itself:
// from zero velocity, one step's gravity (in air and water: all that they do) must leave zero velocity, or
// turning that such places could stop. Tested in tests/engine/modes/resting_test.cpp and
// tests/physics/friction/stick_slip_test.cpp and toppling_test.cpp.

#include <span>

#include "engine/response/sweeps/turning_resistance.h"

namespace carom {

/// Whether a body's fastest point is slower than what counts as lying still.
bool liesStill(const Velocity& velocity, double radius_m);

/// One island: rows refer to `bodies`; those with zero inverse mass are what it lies on.
struct RestQuestion {
  std::span<const ContactRow> rows;  ///< With the impulses of the last step as the guess.
  std::span<const ImpulseBody> bodies;
  std::span<const double> radii;  ///< Of the bodies, metres.
  Vec3 gravity = Vec3::Zero();
  double step_s = 0.0;
  /// What gravity, air and water give each body in a step from standstill; empty: gravity alone. Where more
  /// than gravity may push, (2) alone decides.
  std::span<const Velocity> pushes = {};
  /// How far, one a row, metres, its point may be beside the true one. It can hold a body on two points that
  /// would turn, ever so slowly, about the axis through them; it holds nothing that slides. Empty: nowhere.
  std::span<const double> slack_m = {};
  /// Where given, one a row, (2) leaves its loads here, also when they do not balance yet: a better guess.
  std::span<RowLoad> balance = {};
};

/// (1) and (2) above. Cost: a converged contact solve; ask rarely.
bool canRest(const RestQuestion& question);

}  // namespace carom
