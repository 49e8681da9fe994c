// Every shipped scene in motion: a renderer that draws frame after frame, and only what differs from the one
// before, makes the same bytes as one that draws each in full.

#include <algorithm>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_choice.h"
#include "demos/language/scene_file.h"
#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_states.h"
#include "demos/scene/camera_path.h"
#include "demos/scene/drawn_water.h"
#include "demos/scene/scene_world.h"
#include "renderer/frame/frame_renderer.h"

namespace carom::demos {
namespace {

constexpr int kWidth = 400, kHeight = 225;
constexpr double kFps = 120.0;

// The first frames one by one, then a few a second.
std::vector<int> drawnFrames() {
  std::vector<int> frames;
  for (int frame = 0; frame < 200; frame += frame < 16 ? 1 : 11) frames.push_back(frame);
  return frames;
}

class RedrawnScenes : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(RedrawnScenes, AreDrawnAsInFull) {
  const Scene scene = readSceneFile(GetParam());
  SceneWorld made = makeSceneWorld(scene, std::nullopt);
  const FrameClock clock({kFps, scene.rate_hz});
  FrameStates states(made.world, clock, [](const World&) {});
  const CameraPath main(chosenCamera(scene, "").camera, made, static_cast<double>(kWidth) / kHeight);
  const CameraPath fit(chosenCamera(scene, "fit").camera, made, static_cast<double>(kWidth) / kHeight);
  const renderer::Settings settings{kWidth, kHeight};
  renderer::FrameRenderer lasting(settings, made.world.solids()), full(settings, made.world.solids());
  for (const int frame : drawnFrames()) {
    const std::span<const BodyState> bodies = states.advanceTo(frame);
    const double time_s = clock.time(frame);
    const std::vector<renderer::Instance> instances = drawnInstances(made, bodies);
    const renderer::Camera camera = (frame % 60 < 40 ? main : fit).at(time_s, bodies);
    const std::vector<renderer::WaterVolume> water = drawnWater(scene, time_s);
    full.draw({}, {camera.target, camera.eye, 20.0});  // So that the next is drawn in full.
    const renderer::Image& expected = full.draw(instances, camera, {}, water);
    EXPECT_TRUE(lasting.draw(instances, camera, {}, water).rgb == expected.rgb) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RedrawnScenes, testing::ValuesIn(shippedScenes()), [](const auto& scene) {
  std::string name = scene.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace carom::demos
