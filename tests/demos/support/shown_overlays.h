#pragma once
// A scene's run up to a frame with overlays painted over plain grey, and the questions that tests ask of the
// pixels.

#include <cmath>
#include <optional>

#include "demos/asset/asset_path.h"
#include "demos/language/scene_choice.h"
#include "demos/language/scene_file.h"
#include "demos/overlay/overlays.h"

namespace carom::demos {

/// Whether a pixel within `reach` of a place has the colour, each channel to `slack` of 255.
inline bool inked(const renderer::Image& image, const Vec2& at, const renderer::Color& color, int reach = 1,
                  int slack = 40) {
  const auto near = [&](std::uint8_t channel, float wanted) {
    return std::abs(static_cast<double>(channel) - 255.0 * static_cast<double>(wanted)) <= slack;
  };
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const int x = static_cast<int>(std::floor(at.x())) + dx, y = static_cast<int>(std::floor(at.y())) + dy;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
      const std::uint8_t* p = image.pixel(x, y);
      if (near(p[0], color.r) && near(p[1], color.g) && near(p[2], color.b)) return true;
    }
  return false;
}

inline renderer::Image plainImage(int width, int height, std::uint8_t value = 128) {
  return {width, height,
          std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                    value)};
}

struct ShownOverlays {
  static constexpr int kWidth = 1280, kHeight = 720;

  ShownOverlays(const std::filesystem::path& file, const std::string& names, int frame,
                const std::string& focus = "", double fps = 30.0)
      : scene(readSceneFile(file)),
        made(makeSceneWorld(scene, std::nullopt)),
        clock({fps, scene.rate_hz}),
        overlays({readOverlays(names), focus, false}, made, clock),
        source(made, clock, facts, overlays.phases()),
        camera(chosenCamera(scene, "").camera),
        state(overlays.advance(source, frame)),
        shown(overlays.frameOf(state, frame)) {
    image = overlays.paint(plainImage(kWidth, kHeight), {}, shown, camera);
  }

  Vec2 pixel(const Vec3& p_W) const { return *renderer::projectToPixel(camera, kWidth, kHeight, p_W); }
  bool inked(const Vec3& p_W, const renderer::Color& color, int reach = 1, int slack = 40) const {
    return demos::inked(image, pixel(p_W), color, reach, slack);
  }
  bool changed(const Vec3& p_W) const {
    const Vec2 at = pixel(p_W);
    return image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[0] != 128 ||
           image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[2] != 128;
  }

  Scene scene;
  SceneWorld made;
  FrameClock clock;
  RunFacts facts;
  Overlays overlays;
  FrameSource source;
  renderer::Camera camera;
  FrameState state;
  OverlayFrame shown;
  renderer::Image image;
};

}  // namespace carom::demos
