#pragma once
// The table of `physics` (physics.cpp has the command line): a row is one experiment with a closed form,
// measured in every library there was when this was built; ours is held to the goal.

#include <functional>
#include <string>
#include <vector>

#include "tests/physics/experiments/experiment.h"

namespace carom::bench {

/// What one library made of a row.
struct Figure {
  std::string text;
  bool met = false;  ///< Whether it reaches our goal.
};

struct Row {
  std::string name;         ///< Lower case, hyphens: what is typed to ask for it.
  std::string measured;     ///< What the figures are, with the conditions that matter.
  std::string closed_form;  ///< What theory says they are.
  std::string goal;
  std::function<Figure(const physics::Simulator&)> measure;
  bool is_long = false;  ///< Takes minutes: runs only when asked for.
};

std::vector<Row> impactRows();    ///< Bounces, blows, cradles.
std::vector<Row> frictionRows();  ///< Sliding, sticking, rolling.
std::vector<Row> tippingRows();   ///< Spinning, toppling, rocking, falling.
std::vector<Row> pileRows();      ///< What stands.
std::vector<Row> speedRows();     ///< What comes through.

/// Ours first, then the peers that were there when this was built.
std::vector<physics::Simulator> simulators();

// Figures. A number that is no number never meets a goal.

/// `text` is printf's for the one value.
Figure within(const char* format, double value, double low, double high);
/// A relative error as a percentage; `allowed` is a share, either way.
Figure errorWithin(double error, double allowed);
/// Not longer than `most_m`; written in millimetres, from a metre on in metres.
Figure lengthWithin(double length_m, double most_m);
/// All must be met; their texts with " / " between them.
Figure allOf(const std::vector<Figure>& figures);

}  // namespace carom::bench
