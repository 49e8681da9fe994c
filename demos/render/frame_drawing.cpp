#include "demos/render/frame_drawing.h"

#include <utility>

#include "demos/frames/frame_identity.h"
#include "demos/scene/drawn_water.h"
#include "demos/system/interrupt.h"
#include "demos/video/caption_painter.h"

namespace carom::demos {
namespace {

/// Milliseconds since the last call.
class Stopwatch {
 public:
  double lap_ms() {
    const double now_s = steadySeconds();
    const double lap = 1000.0 * (now_s - last_s_);
    last_s_ = now_s;
    return lap;
  }

 private:
  double last_s_ = steadySeconds();
};

/// The frame's other outputs, without their pixels; in a stream they have no files either.
std::vector<OutputToWrite> plannedOutputs(const RenderRun& run, const FrameToWrite& frame) {
  std::vector<OutputToWrite> outputs;
  for (const FrameOutput output : run.plan.outputs) {
    std::filesystem::path path;
    if (run.names != nullptr) path = run.names->file(frame.record.frame, nameOf(output));
    outputs.push_back(
        {{}, path, outputText(output, frame.text, run.scale), {nameOf(output), path.filename().string(), 0}});
  }
  return outputs;
}

void drawOutputs(const RenderRun& run, renderer::FrameRenderer& pictures, FrameToWrite& frame) {
  for (std::size_t i = 0; i < frame.outputs.size(); ++i)
    frame.outputs[i].raster = outputRaster(run.plan.outputs[i], pictures.surfaces(), run.scale);
}

bool wantsPixels(const RenderRun& run) {
  return run.recorder != nullptr && run.recorder->wantsPixels(run.manifest.width, run.manifest.height);
}

}  // namespace

bool keepFrame(const RenderRun& run, FrameToWrite& frame) {
  if (!run.resume) return false;
  const FrameSize size{run.manifest.width, run.manifest.height};
  const std::optional<std::uint64_t> pixels = wantedFrame(frame.path, frame.text, size);
  if (!pixels) return false;
  std::vector<OutputRecord> outputs;
  for (const OutputToWrite& output : frame.outputs) {
    const std::optional<std::uint64_t> samples = wantedOutput(output.path, output.text, size);
    if (!samples) return false;
    outputs.push_back(output.record);
    outputs.back().pixel_hash = *samples;
  }
  frame.record.outputs = std::move(outputs);
  frame.record.pixel_hash = *pixels;
  frame.record.kept = true;
  return true;
}

FrameToWrite plannedFrame(const RenderRun& run, const FrameJob& job) {
  FrameToWrite next;
  next.record.timings.physics_ms = job.physics_ms;
  if (run.names != nullptr) next.path = run.names->file(job.frame);
  next.record.frame = job.frame;
  next.record.file = next.path.filename().string();
  next.record.time_s = run.plan.clock.time(job.frame);
  next.record.step = job.state.step;
  next.record.state_hash = job.state.state_hash;
  next.text = frameText(run.manifest, next.record);
  next.outputs = plannedOutputs(run, next);
  return next;
}

void recordShot(const RenderRun& run, const FrameJob& job, const FrameToWrite& next) {
  if (run.recorder == nullptr) return;
  const double time_s = next.record.time_s;
  run.recorder->addShot({next.record.file, next.text}, time_s, job.state,
                        run.camera.at(time_s, job.state.bodies));
}

void recordKept(const RenderRun& run, renderer::FrameRenderer& pictures, const FrameJob& job) {
  const int width = run.manifest.width, height = run.manifest.height;
  if (!wantsPixels(run) || run.recorder->recallPixels(width, height)) return;
  const double time_s = run.plan.clock.time(job.frame);
  pictures.draw(drawnInstances(run.scene, job.state.bodies), run.camera.at(time_s, job.state.bodies));
  run.recorder->addPixels(pictures.surfaces(), width, height);
}

void drawFrame(const RenderRun& run, renderer::FrameRenderer& pictures, const FrameJob& job,
               FrameToWrite& next) {
  Stopwatch watch;
  const renderer::Camera camera = run.camera.at(next.record.time_s, job.state.bodies);
  const std::vector<renderer::WaterVolume> water = drawnWater(run.plan.scene, next.record.time_s);
  if (job.moments.empty()) {
    next.image = run.overlays.draw(pictures, job.state, job.frame, camera, water);
  } else {
    std::vector<std::vector<renderer::Instance>> moments;
    for (const std::vector<BodyState>& bodies : job.moments)
      moments.push_back(drawnInstances(run.scene, bodies));
    next.image = pictures.draw(moments.back(), camera, {}, water, moments);
  }
  if (run.caption != nullptr)
    next.image = withCaption(std::move(next.image), run.caption->at(next.record.time_s, job.state.bodies));
  drawOutputs(run, pictures, next);
  if (wantsPixels(run)) run.recorder->addPixels(pictures.surfaces(), run.manifest.width, run.manifest.height);
  next.record.timings.draw_ms = watch.lap_ms();
}

FrameJob nextJob(RenderRun& run, int frame) {
  throwIfInterrupted();
  Stopwatch watch;
  std::vector<std::vector<BodyState>> moments;
  FrameState state;
  if (run.plan.shutter.isOpen()) {
    for (const int moment : run.plan.shutter.moments(frame)) {
      state = run.source.at(moment);
      moments.emplace_back(state.bodies.begin(), state.bodies.end());
    }
  } else {
    state = run.overlays.advance(run.source, frame);
  }
  return {frame, state, watch.lap_ms(), std::move(moments)};
}

}  // namespace carom::demos
