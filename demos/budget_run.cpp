#include "demos/budget_run.h"

#include <algorithm>
#include <numeric>

#include "demos/drawn_water.h"
#include "demos/frame_states.h"
#include "demos/interrupt.h"
#include "demos/phase_stopwatch.h"
#include "demos/progress.h"
#include "demos/replays.h"
#include "demos/simulation_check.h"
#include "renderer/png.h"

namespace carom::demos {
namespace {

void addWork(FrameCost& cost, const StepCounters& step) {
  cost.contacts = std::max(cost.contacts, step.contact_points);
  cost.pairs = std::max(cost.pairs, step.candidate_pairs);
  cost.queries += step.distance_queries;
  cost.events += step.events;
}

void drawAndEncode(PhaseStopwatch& watch, renderer::FrameRenderer& pictures,
                   std::span<const renderer::Instance> instances, const renderer::Camera& camera,
                   std::span<const renderer::WaterVolume> water) {
  watch.begin(FramePhase::kDraw);
  const auto drawn = [&watch] {
    watch.end();
    watch.begin(FramePhase::kReadback);
  };
  const renderer::Image& image = pictures.draw(instances, camera, drawn, water);
  watch.end();
  const FramePhaseScope phase(watch, FramePhase::kEncode);
  renderer::encodePng(image);
}

Replay runOnce(const ReplayPlan& plan, renderer::FrameRenderer& pictures,
               const std::function<void(int)>& done) {
  SceneWorld scene = makeSceneWorld(plan.scene, plan.mesh, plan.threads);
  pictures.draw(drawnInstances(scene, scene.world.states()), plan.camera.at(0.0, scene.world.states()), {},
                drawnWater(plan.scene, 0.0));
  PhaseStopwatch watch(steadySeconds, plan.keeps_slices);
  RunFacts facts;
  FrameCost cost;
  FrameStates states(
      scene.world, plan.clock,
      [&](const World& world) {
        const Audit audit = world.audit();
        checkStep(world, audit, scene.names, facts);
        addWork(cost, audit.last_step);
      },
      &watch);
  Replay replay;
  for (int frame = 0; frame < plan.frames; ++frame) {
    throwIfInterrupted();
    cost = {};
    watch.beginFrame(frame);
    const std::span<const BodyState> bodies = states.advanceTo(frame);
    const std::vector<renderer::Instance> instances = drawnInstances(scene, bodies);
    const double time_s = plan.clock.time(frame);
    drawAndEncode(watch, pictures, instances, plan.camera.at(time_s, bodies), drawnWater(plan.scene, time_s));
    watch.endFrame(cost);
    cost.time_s = plan.clock.time(frame);
    cost.state_hash = scene.world.stateHash();
    replay.frames.push_back(cost);
    done(frame + 1);
  }
  replay.slices = watch.takeSlices();
  return replay;
}

double totalOf(const Replay& replay) {
  const std::vector<double> times_ms = totals_ms(replay.frames);
  return std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
}

}  // namespace

std::vector<Replay> runReplays(const ReplayPlan& plan, renderer::FrameRenderer& pictures,
                               const std::function<void(int)>& done) {
  std::vector<Replay> replays;
  std::size_t quickest = 0;
  for (int r = 0; r < plan.replays; ++r) {
    replays.push_back(runOnce(plan, pictures, [&](int frames) { done(r * plan.frames + frames); }));
    if (r == 0) continue;
    const bool quicker = totalOf(replays.back()) < totalOf(replays[quickest]);
    replays[quicker ? quickest : replays.size() - 1].slices = {};
    if (quicker) quickest = replays.size() - 1;
  }
  return replays;
}

}  // namespace carom::demos
