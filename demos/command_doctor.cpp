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

/// Throws NoRenderer when there is no context or it draws nothing.
void drawWith(renderer::GlBackend backend) {
  const std::vector<Solid> solids = {Solid::box({20.0, 20.0, 1.0}), Solid::ball(0.8)};
  renderer::Settings settings{.width = 160, .height = 90};
  settings.backend = backend;
  renderer::FrameRenderer pictures(settings, solids);
  line("GL renderer", pictures.info().renderer);
  line("GL version", pictures.info().version);
  line("MSAA limit", std::to_string(pictures.info().max_samples) + " samples");
  if (!drawsSomething(pictures)) throw renderer::NoRenderer("the test render is blank");
  line("test render", "ok (160x90)");
}

/// The back end that must draw.
void examineRenderer(renderer::GlBackend backend) {
  const bool is_egl = backend == renderer::GlBackend::kEgl;
  line("GL context", is_egl ? "EGL without a surface (--gl egl)" : "OSMesa (--gl osmesa)");
  try {
    drawWith(backend);
  } catch (const renderer::WrongDriver&) {
    throw;
  } catch (const renderer::NoRenderer& error) {
    const std::string packages = is_egl ? "libegl1 libegl-mesa0 libgl1-mesa-dri" : "libosmesa6";
    throw renderer::NoRenderer(std::string(error.what()) + "; get it with: apt-get install " + packages);
  }
}

/// The one that nothing needs while OSMesa is there.
void tellOfEgl() {
  try {
    renderer::createOffscreenContext(renderer::PixelPolicy::kFast, renderer::GlBackend::kEgl);
    line("EGL", "there as well (doctor --gl egl tries it)");
  } catch (const renderer::NoRenderer& error) {
    line("EGL", std::string("not here, and not needed: ") + error.what());
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

ExitCode doctor(const DoctorOptions& options) {
  line("carom", programVersion() + " (" + buildName() + ")");
  line("CPU", cpuClass());
  for (const auto& [library, version] : libraryVersions()) line(library, version);
  examineAssets();
  examineRenderer(options.gl.empty() ? renderer::GlBackend::kOsmesa : renderer::backendOf(options.gl));
  if (options.gl.empty()) tellOfEgl();
  line("missing", "nothing");
  return ExitCode::kOk;
}

}  // namespace carom::demos
