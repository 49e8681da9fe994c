#pragma once
// Rows of bodies that turn, in the middle of their step. While a body turns about a contact, the arm to the
// contact turns too (DEVIATES: the paper takes contacts where the step begins): what holds the contact at the
// beginning of a step lets it move at the end. Impulses do work on the mean of the velocities before and
// after, so their rows stand where the bodies are in mid-step, and ask there for the velocity that will be
// nought at the step's end: a block rocks on its edge, a coin on its rim, without gain or loss (to third
// order in the step). Internal to the simulation floor. Tested in
// tests/physics/friction/rocking_block_test.cpp.

#include <span>

#include "engine/simulation/bodies/half_turn.h"
#include "engine/simulation/contacts/contact_rows.h"

namespace carom {

/// The world in the middle of the step: how far ahead that is, and what turning is worth a look there.
struct MidStep {
  const std::vector<Body>& bodies;
  const std::vector<Shape>& shapes;
  std::span<const ImpulseBody> solver_bodies;
  double half_step_s = 0.0;
  double noticed_mps = 0.0;              ///< Speed by which a contact's arms change in half a step.
  std::span<const HalfTurn> half_turns;  ///< Of the world's bodies.
};

/// Moves the rows of one pair, as `appendRows` made them for `request`, to mid-step, where the velocities of
/// the solver's bodies carry the two; their coefficients stay. Rows of points that are not there then stay.
/// Whether the contact lasts: not one of bodies that turn by radians a step and are apart by then, or within
/// each other, by more than `request.height_m`. No force that acts all the step is that of such a contact.
bool moveToMidStep(const RowRequest& request, const ShapePair& pair, const MidStep& mid,
                   std::span<SourcedRow> rows, StepCounters& counters);

}  // namespace carom
