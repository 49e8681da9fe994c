#include "demos/command/renderer_examination.h"

#include <set>
#include <vector>

#include "renderer/frame/frame_renderer.h"
#include "renderer/gl/offscreen_context.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {

using renderer::GlBackend;

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

/// Who drew. Throws NoRenderer when there is no context or it draws nothing.
GlBackend drawWith(GlBackend backend) {
  const std::vector<Solid> solids = {Solid::box({20.0, 20.0, 1.0}), Solid::ball(0.8)};
  renderer::Settings settings{.width = 160, .height = 90};
  settings.backend = backend;
  renderer::FrameRenderer pictures(settings, solids);
  const renderer::ContextInfo info = pictures.info();
  const std::string maker = info.backend == GlBackend::kEgl ? "EGL without a surface" : "OSMesa";
  tellFact("GL context", maker + " (" + info.reason + ")");
  tellFact("GL renderer", info.renderer);
  tellFact("GL version", info.version);
  tellFact("MSAA limit", std::to_string(info.max_samples) + " samples");
  if (!drawsSomething(pictures)) throw renderer::NoRenderer("the test render is blank");
  tellFact("test render", "ok (160x90)");
  return info.backend;
}

/// Debian's packages that bring the context.
std::string packagesOf(GlBackend backend) {
  const std::string osmesa = "libosmesa6", egl = "libegl1 libegl-mesa0 libgl1-mesa-dri";
  if (backend == GlBackend::kAuto) return osmesa + ", or " + egl;
  return backend == GlBackend::kEgl ? egl : osmesa;
}

void tellOfTheOther(GlBackend other) {
  const std::string name = other == GlBackend::kEgl ? "EGL" : "OSMesa";
  try {
    renderer::createOffscreenContext(renderer::PixelPolicy::kFast, other);
    tellFact(name, "there as well (doctor --gl " + renderer::nameOf(other) + " tries it)");
  } catch (const renderer::NoRenderer& error) {
    tellFact(name, std::string("not here, and not needed: ") + error.what());
  }
}

}  // namespace

void examineRenderer(const std::string& gl) {
  const GlBackend asked = renderer::backendOf(gl);
  GlBackend drew{};
  try {
    drew = drawWith(asked);
  } catch (const renderer::WrongDriver&) {
    throw;
  } catch (const renderer::NoRenderer& error) {
    throw renderer::NoRenderer(std::string(error.what()) + "; get it with: apt-get install " +
                               packagesOf(asked));
  }
  if (asked == GlBackend::kAuto)
    tellOfTheOther(drew == GlBackend::kEgl ? GlBackend::kOsmesa : GlBackend::kEgl);
}

}  // namespace carom::demos
