#pragma once
// Delta debugging (Zeller, Hildebrandt 2002) of a scene: while it still fails in the same kind, to at least a
// tenth of the figure, the run is shortened, bodies are left out, and what remains is made plainer and its
// numbers rounder. Tested in tests/explore/shrink_test.cpp.

#include <functional>
#include <optional>

#include "tests/explore/trial/world_trial.h"

namespace carom::explore {

/// Runs a scene; its finding of the kind looked for, if it has one.
using Trial = std::function<std::optional<Finding>(const demos::Scene&)>;

struct Shrunk {
  demos::Scene scene;
  Finding finding;
  int trials = 0;
};

/// `finding` is what `scene` shows. At most `most_trials` runs.
Shrunk shrunkScene(const demos::Scene& scene, const Finding& finding, const Trial& trial, int most_trials);

}  // namespace carom::explore
