#include "tests/explore/trial/world_trial.h"

#include <array>
#include <cmath>

#include "demos/scene/scene_world.h"
#include "demos/scene/shape_solid.h"
#include "engine/foundation/contract.h"

namespace carom::explore {
namespace {

/// Two instants of a step, others in each: multiples of the golden ratio lie evenly.
std::array<double, 2> sharesOf(int step) {
  const double turns = 0.6180339887498949 * step;
  const double share = turns - std::floor(turns);
  return {0.5 * share, 0.5 + 0.5 * share};
}

class WorldTrial {
 public:
  WorldTrial(const demos::Scene& scene, const TrialSettings& settings) : scene_(scene), settings_(settings) {}

  TrialOutcome run() {
    try {
      runSteps();
    } catch (const ContractViolation& violation) {
      outcome_.findings.push_back({"abort", 1.0, step_, violation.what()});
    } catch (const InputError& error) {
      judgeRefusal(error.what());
    }
    return outcome_;
  }

 private:
  World makeWorld(int threads) {
    if (settings_.before_start) settings_.before_start();
    if (settings_.make_world) return settings_.make_world(scene_, threads);
    return demos::makeSceneWorld(scene_, {}, threads).world;
  }
  void stepOnce(World& world) {
    if (settings_.before_step) settings_.before_step();
    world.step();
  }

  void runSteps() {
    World world = makeWorld(1);
    WorldJudge judge(scene_, world);
    world.keepPaths(true);
    std::vector<BodyState> between;
    const int steps = stepsOf(scene_);
    for (step_ = 1; step_ <= steps; ++step_) {
      stepOnce(world);
      for (const double share : sharesOf(step_)) {
        world.statesWithin(share, between);
        judge.lookBetween(between, step_);
      }
      judge.lookAlong([&world](double share, std::vector<BodyState>& at) { world.statesWithin(share, at); });
      if (!judge.look(world.states(), world.audit().last_step, step_)) break;
    }
    judge.conclude(steps);
    compareHashes(world, judge.findings());
    outcome_ = {judge.findings().list(), judge.totals()};
  }

  void compareHashes(const World& world, Findings& findings) {
    const auto compare = [&](int threads, const char* kind) {
      World again = makeWorld(threads);
      while (again.stepCount() < world.stepCount()) stepOnce(again);
      if (again.stateHash() != world.stateHash())
        findings.add(kind, 1.0, world.stepCount(), "other bits with " + std::to_string(threads) + " threads");
    };
    if (settings_.replays) compare(1, "replay");
    if (!settings_.threads) return;
    compare(2, "threads");
    compare(3, "threads");
  }

  void judgeRefusal(const std::string& message) {
    outcome_.totals.refused = 1;
    if (!overlapOfStart(scene_)) outcome_.findings.push_back({"refused", 1.0, 0, message});
  }

  const demos::Scene& scene_;
  const TrialSettings& settings_;
  TrialOutcome outcome_;
  int step_ = 0;
};

}  // namespace

TrialOutcome tryWorld(const demos::Scene& scene, const TrialSettings& settings) {
  return WorldTrial(scene, settings).run();
}

std::optional<Meeting> overlapOfStart(const demos::Scene& scene) {
  World world{WorldSettings{}};
  double rounding_m = 0.0;
  for (const demos::Body& body : scene.bodies) {
    const int solid = world.addSolid(demos::makeSolid(body.shape, {}));
    BodyDescription d;
    d.solid = solid;
    d.is_static = body.is_static;
    const Pose& X_WS = body.keyframes.empty() ? body.X_WS : body.keyframes.front().X_WB;
    d.X_WB = X_WS * Pose{Quat::Identity(), -world.solids().back().origin_B()};
    world.addBody(d);
    rounding_m = std::max(rounding_m, 0x1p-44 * (d.X_WB.position.norm() + world.solids().back().radius()));
  }
  std::optional<Meeting> deepest = ApartWatch(world).deepest(world.states());
  if (deepest && deepest->depth_m <= rounding_m) deepest.reset();
  return deepest;
}

}  // namespace carom::explore
