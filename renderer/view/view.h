#pragma once
// What is drawn and how, as plain values: bodies with their poses and colours, and the look of the whole.

#include "engine/foundation/frames.h"
#include "renderer/image/color.h"
#include "renderer/look/light.h"
#include "renderer/look/surface.h"
#include "renderer/view/gl_backend.h"
#include "renderer/view/preset.h"

namespace carom::renderer {

/// One body to draw.
struct Instance {
  int solid = 0;  ///< Index into the solids given to the renderer.
  Pose X_WB;
  Color color;
  /// Draw level faces with a pattern of the world's xy (grounds), a checker board unless `pattern` says
  /// otherwise: squares of 1 m; of a power of ten metres where the camera is so near or far that those would
  /// be useless. The lowest such instance whose top is level is drawn as an endless plane that fades into the
  /// horizon, whatever its own size; it casts no shadow.
  bool checker = false;
  GroundPattern pattern = GroundPattern::kChecker;  ///< A checker board has colours of its own.
  Surface surface = {};                             ///< Of a body that is no ground.
};

/// The longest side of an image.
inline constexpr int kMaxImageSide = 16384;

struct Settings {
  int width = 1280;
  int height = 720;
  Light light = {};
  PixelPolicy pixels =
      PixelPolicy::kFast;  ///< kPortable for golden frames; the first renderer of a process decides.
  Preset preset = Preset::kRealtime;
  Style style = Style::kDaylight;
  /// Draws bodies and the shadows on the ground alone, with the image's alpha; neither sky nor ground nor
  /// air.
  bool cutout = false;
  GlBackend backend = GlBackend::kAuto;
  int gl_threads =
      0;  ///< That fill pixels; 0: as many as Mesa likes. The first renderer of a process decides.
};

/// What the preset means in this style and light.
Quality qualityOf(const Settings& settings);

}  // namespace carom::renderer
