#pragma once
// Runs a scene and has every step judged; now and then also that a replay, and two and
// three threads, give the same bits. A start that is refused is looked at afresh. Tested in
// tests/explore/trial/world_trial_test.cpp.

#include <functional>

#include "tests/explore/random_world.h"
#include "tests/explore/watch/world_judge.h"

namespace carom::explore {

struct TrialSettings {
  bool replays = false;                     ///< Runs it a second time and compares hashes.
  bool threads = false;                     ///< Also with two and three threads.
  std::function<void()> before_start = {};  ///< Arms the clock that ends the making of a world.
  std::function<void()> before_step = {};   ///< Likewise a step which takes too long.
  /// What makes the world for a number of threads; none: makeSceneWorld.
  std::function<World(const demos::Scene&, int)> make_world = {};
};

struct TrialOutcome {
  std::vector<Finding> findings;  ///< At most one of each kind: the worst.
  TrialTotals totals;
};

TrialOutcome tryWorld(const demos::Scene& scene, const TrialSettings& settings);

/// The deepest overlap of the poses as the scene gives them, if it is more than their rounding.
std::optional<Meeting> overlapOfStart(const demos::Scene& scene);

}  // namespace carom::explore
