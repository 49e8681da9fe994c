// `carom doctor`: what this machine gives the program, tried rather than believed.
#include "demos/command.h"

#include <iostream>
#include <set>

#include "demos/asset_path.h"
#include "demos/build_info.h"
#include "demos/scene_file.h"
#include "demos/scene_world.h"
#include "engine/foundation/contract.h"
#include "renderer/frame_renderer.h"
#include "renderer/png.h"

namespace carom::demos {
namespace {

void line(const std::string& what, const std::string& answer) {
  std::cout << what << std::string(what.size() < 16 ? 16 - what.size() : 1, ' ') << answer << '\n';
}

/// A ball over a checkered ground, small: the picture must hold more than a handful of colours.
bool drawsSomething(renderer::FrameRenderer& pictures) {
  const std::vector<renderer::Instance> instances = {
      {0, Pose{Quat::Identity(), Vec3(0.0, 0.0, -0.5)}, {}, true},
      {1, Pose{Quat::Identity(), Vec3(0.0, 0.0, 1.0)}, {0.9f, 0.4f, 0.1f}, false}};
  const renderer::Image& image = pictures.draw(instances, renderer::Camera());
  std::set<int> colors;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      colors.insert(p[0] << 16 | p[1] << 8 | p[2]);
    }
  constexpr std::size_t kBlankAtMost = 16;
  return colors.size() > kBlankAtMost && !renderer::encodePng(image).empty();
}

/// Throws NoRenderer when GL is missing or draws nothing.
void examineRenderer() {
  const std::vector<Solid> solids = {Solid::box({20.0, 20.0, 1.0}), Solid::ball(0.8)};
  try {
    renderer::FrameRenderer pictures({160, 90}, solids);
    line("GL renderer", pictures.info().renderer);
    line("GL version", pictures.info().version);
    line("MSAA limit", std::to_string(pictures.info().max_samples) + " samples");
    if (!drawsSomething(pictures)) throw renderer::NoRenderer("the test render is blank");
    line("test render", "ok (160x90)");
  } catch (const renderer::NoRenderer& error) {
    throw renderer::NoRenderer(std::string(error.what()) + "; get it with: apt-get install libosmesa6");
  }
}

void examineAssets() {
  int scenes = 0;
  for (const std::filesystem::path& path : shippedScenes()) {
    makeSceneWorld(readSceneFile(path), std::nullopt);
    ++scenes;
  }
  if (scenes == 0) throw InputError(assetsFolder().string() + ": holds no scenes");
  line("assets", assetsFolder().string() + " (" + std::to_string(scenes) + " scenes, all valid)");
}

}  // namespace

ExitCode doctor() {
  line("carom", programVersion() + " (" + buildName() + ")");
  line("CPU", cpuClass());
  for (const auto& [library, version] : libraryVersions()) line(library, version);
  examineAssets();
  examineRenderer();
  line("missing", "nothing");
  return ExitCode::kOk;
}

}  // namespace carom::demos
