#include "demos/budget/budget_run.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "demos/budget/replays.h"
#include "demos/format/progress.h"
#include "demos/motion/frame_states.h"
#include "demos/motion/phase_stopwatch.h"
#include "demos/motion/simulation_check.h"
#include "demos/scene/drawn_water.h"
#include "demos/scene/scene_caption.h"
#include "demos/system/interrupt.h"
#include "demos/video/caption_painter.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

void addWork(FrameCost& cost, const StepCounters& step) {
  cost.contacts = std::max(cost.contacts, step.contact_points);
  cost.pairs = std::max(cost.pairs, step.candidate_pairs);
  cost.queries += step.distance_queries;
  cost.events += step.events;
  cost.worked(Work::kSteps) += step.substeps;
  cost.worked(Work::kPairs) += step.candidate_pairs;
  cost.worked(Work::kQueries) += step.distance_queries;
  cost.worked(Work::kStatesWalked) += step.states_walked;
  cost.worked(Work::kContactPoints) += step.contact_points;
  cost.worked(Work::kRowVisits) += step.row_visits;
  cost.worked(Work::kLandings) += step.landings;
  cost.worked(Work::kProjectedPaths) += step.projected_paths;
  cost.worked(Work::kClearedPaths) += step.cleared_paths;
  cost.worked(Work::kEvents) += step.events;
  cost.worked(Work::kImpacts) += step.impacts;
  cost.worked(Work::kNewtonSteps) += step.newton_steps;
}

struct DrawnFrame {
  std::span<const renderer::Instance> instances;
  renderer::Camera camera;
  std::span<const renderer::WaterVolume> water;
  std::string caption;  // empty: none
};

/// Adds what there was to draw and to pack.
void drawAndEncode(const DrawnFrame& frame, PhaseStopwatch& watch, renderer::FrameRenderer& pictures,
                   renderer::PngSequence& files, FrameCost& cost) {
  watch.begin(FramePhase::kDraw);
  const auto drawn = [&watch] {
    watch.end();
    watch.begin(FramePhase::kReadback);
  };
  const renderer::Image& image = pictures.draw(frame.instances, frame.camera, drawn, frame.water);
  watch.end();
  std::optional<renderer::Image> captioned;
  if (!frame.caption.empty()) {
    const FramePhaseScope phase(watch, FramePhase::kDraw);
    captioned = withCaption(image, frame.caption);
  }
  const FramePhaseScope phase(watch, FramePhase::kEncode);
  const std::size_t bytes = files.encode(captioned ? *captioned : image, {}).size();
  cost.worked(Work::kBytes) = static_cast<std::int64_t>(bytes);
  cost.worked(Work::kBands) = files.packedBands();
  const renderer::DrawWork& work = pictures.work();
  cost.worked(Work::kTriangles) = work.triangles;
  cost.worked(Work::kPixels) = work.pixels;
  cost.worked(Work::kShadowTexels) = work.shadow_texels;
  cost.worked(Work::kMirrorTexels) = work.mirror_texels;
}

double totalOf(const Replay& replay) {
  const std::vector<double> times_ms = totals_ms(replay.frames);
  return std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
}

}  // namespace

struct FrameLoop::Parts {
  Parts(const ReplayPlan& asked, renderer::FrameRenderer& pictures_)
      : plan(asked),
        pictures(pictures_),
        scene(makeSceneWorld(plan.scene, plan.mesh, plan.threads)),
        caption(plan.scene, scene),
        watch(plan.clock_s, plan.keeps_slices),
        states(
            scene.world, plan.clock,
            [this](const World& world) {
              const Audit audit = world.audit();
              checkStep(world, audit, scene.names, facts);
              addWork(cost, audit.last_step);
            },
            &watch) {
    pictures.draw(drawnInstances(scene, scene.world.states()), plan.camera.at(0.0, scene.world.states()), {},
                  drawnWater(plan.scene, 0.0));
    pictures.drawAnew();  // shaders are compiled; the first frame is a frame as any other
  }

  const ReplayPlan& plan;
  renderer::FrameRenderer& pictures;
  renderer::PngSequence files;
  SceneWorld scene;
  SceneCaption caption;
  PhaseStopwatch watch;
  RunFacts facts;
  FrameCost cost;
  int frame = 0;
  FrameStates states;
};

FrameLoop::FrameLoop(const ReplayPlan& plan, renderer::FrameRenderer& pictures)
    : parts_(std::make_unique<Parts>(plan, pictures)) {}
FrameLoop::~FrameLoop() = default;

FrameCost FrameLoop::next() {
  throwIfInterrupted();
  Parts& p = *parts_;
  p.cost = {};
  p.watch.beginFrame(p.frame);
  const std::span<const BodyState> bodies = p.states.advanceTo(p.frame);
  const std::vector<renderer::Instance> instances = drawnInstances(p.scene, bodies);
  const double time_s = p.plan.clock.time(p.frame);
  const auto water = drawnWater(p.plan.scene, time_s);
  const std::string caption = p.caption.empty() ? std::string() : p.caption.at(time_s, bodies);
  drawAndEncode({instances, p.plan.camera.at(time_s, bodies), water, caption}, p.watch, p.pictures, p.files,
                p.cost);
  p.watch.endFrame(p.cost);
  p.cost.time_s = time_s;
  p.cost.state_hash = p.scene.world.stateHash();
  ++p.frame;
  return p.cost;
}

std::vector<PhaseSlice> FrameLoop::takeSlices() {
  return parts_->watch.takeSlices();
}

std::vector<Replay> runReplays(const ReplayPlan& plan, renderer::FrameRenderer& pictures,
                               const std::function<void(int)>& done) {
  std::vector<Replay> replays;
  std::size_t quickest = 0;
  for (int r = 0; r < plan.replays; ++r) {
    FrameLoop loop(plan, pictures);
    replays.emplace_back();
    for (int frame = 0; frame < plan.frames; ++frame) {
      replays.back().frames.push_back(loop.next());
      done(r * plan.frames + frame + 1);
    }
    replays.back().slices = loop.takeSlices();
    if (r == 0) continue;
    const bool quicker = totalOf(replays.back()) < totalOf(replays[quickest]);
    replays[quicker ? quickest : replays.size() - 1].slices = {};
    if (quicker) quickest = replays.size() - 1;
  }
  return replays;
}

}  // namespace carom::demos
