#include "demos/motion/frame_source.h"

#include "demos/system/interrupt.h"

namespace carom::demos {

FrameSource::FrameSource(SceneWorld& scene, const FrameClock& clock, RunFacts& facts, PhaseClock* phases,
                         AfterStep watcher)
    : scene_(&scene) {
  const auto after_step = [&scene, &facts, watcher = std::move(watcher)](const World& world) {
    throwIfInterrupted();
    checkStep(world, world.audit(), scene.names, facts);
    if (watcher) watcher(world);
  };
  states_.emplace(scene.world, clock, after_step, phases);
}

FrameState FrameSource::at(int frame) {
  throwIfInterrupted();
  if (recording_ != nullptr) return recording_->advanceTo(frame);
  const std::span<const BodyState> bodies = states_->advanceTo(frame);
  return {bodies, scene_->world.stepCount(), scene_->world.stateHash()};
}

}  // namespace carom::demos
