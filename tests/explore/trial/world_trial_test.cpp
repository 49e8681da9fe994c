// Whole runs: a replay or a thread count that gives other bits is seen, and a refusal without an overlap.

#include "tests/explore/trial/world_trial.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "engine/foundation/contract.h"

namespace carom::explore {
namespace {

demos::Scene fallingBall() {
  return demos::parseScene(R"({"format": 1, "rate": 100, "duration": 0.2, "bodies": [
    {"name": "floor", "static": true, "shape": {"box": [9, 9, 1]}, "position": [0, 0, -0.5]},
    {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "position": [0, 0, 0.7]}]})",
                           "ball.json");
}

bool has(const TrialOutcome& outcome, const std::string& kind) {
  return std::any_of(outcome.findings.begin(), outcome.findings.end(),
                     [&kind](const Finding& finding) { return finding.kind == kind; });
}

TEST(WorldTrial, AnHonestRunIsWithoutFindings) {
  TrialSettings settings;
  settings.replays = settings.threads = true;
  const TrialOutcome outcome = tryWorld(fallingBall(), settings);
  EXPECT_TRUE(outcome.findings.empty());
  EXPECT_EQ(outcome.totals.steps, 20);
}

TEST(WorldTrial, OtherBitsOfAReplayOrOfThreadsAreSeen) {
  TrialSettings settings;
  settings.replays = settings.threads = true;
  int made = 0;
  settings.make_world = [&made](const demos::Scene& scene, int threads) {
    demos::Scene other = scene;
    if (++made == 2 || threads == 3) other.bodies[1].X_WS.position.x() += 1e-15;
    return std::move(demos::makeSceneWorld(other, {}, threads).world);
  };
  const TrialOutcome outcome = tryWorld(fallingBall(), settings);
  EXPECT_TRUE(has(outcome, "replay"));
  EXPECT_TRUE(has(outcome, "threads"));
}

TEST(WorldTrial, ARefusalIsRightOnlyWhereSomethingOverlaps) {
  TrialSettings refusing;
  refusing.make_world = [](const demos::Scene&, int) -> World { throw InputError("overlap"); };
  EXPECT_TRUE(has(tryWorld(fallingBall(), refusing), "refused"));
  demos::Scene sunk = fallingBall();
  sunk.bodies[1].X_WS.position.z() = 0.499;
  EXPECT_FALSE(has(tryWorld(sunk, refusing), "refused"));
  sunk.bodies[1].X_WS.position.z() = 0.5;
  EXPECT_FALSE(overlapOfStart(sunk)) << "touches";
}

TEST(WorldTrial, ABrokenContractIsAFinding) {
  TrialSettings broken;
  broken.make_world = [](const demos::Scene&, int) -> World { throw ContractViolation("bug: planted"); };
  EXPECT_TRUE(has(tryWorld(fallingBall(), broken), "abort"));
}

}  // namespace
}  // namespace carom::explore
