#pragma once
// The values that all passes of a frame share, from the camera, the light and the shadow map's place. Tested
// through the frames of tests/renderer/frame/frame_renderer_test.cpp.

#include <optional>

#include "renderer/draw/shaders.h"
#include "renderer/image/color.h"
#include "renderer/view/preset.h"
#include "renderer/view/projection.h"
#include "renderer/view/shadow_fit.h"

namespace carom::renderer {

struct FrameView {
  Camera camera;
  int width = 0;
  int height = 0;
  DepthRange depth;
  ShadowView shadow;
  int shadow_texels = 0;
  Sample sample;
  std::optional<double> ground_z_E;  ///< Height of the endless ground above the eye.
  Color ground_color = {};           ///< Of a pattern that has no colours of its own.
  double pool = 0.0;                 ///< See Light.
};
FrameBlock frameBlock(const FrameView& view);

/// How far off the ground ends, long since all air, metres.
double horizonDistance(const Camera& camera);

}  // namespace carom::renderer
