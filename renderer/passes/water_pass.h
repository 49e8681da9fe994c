#pragma once
// Draws water over a finished scene: every pixel's ray is followed through the volume in closed form (level
// surfaces) or to the root of its height above the waves, as far as the depth buffer says it is open. What
// lies behind is dimmed by Beer and Lambert's law; the surface mirrors the sky by Schlick's approximation of
// Fresnel's law; a bright line marks where solids cut the surface. Light is not bent: a thing under water
// stays on the pixel where it is. Tested in tests/renderer/passes/water_pass_test.cpp.

#include <span>
#include <string>

#include "renderer/gl/gl_functions.h"
#include "renderer/view/projection.h"
#include "renderer/view/water_volume.h"

namespace carom::renderer {

class WaterPass {
 public:
  /// The scene's image and depth, which must outlive this, as `gl` must.
  struct Scene {
    GLuint color_buffer = 0;   ///< A renderbuffer.
    GLuint depth_texture = 0;  ///< Of the same size.
    int width = 0;
    int height = 0;
  };
  /// Links its program at the first `draw`; `variant` are the lines that choose it (see shaders.h).
  WaterPass(const GlFunctions& gl, const Scene& scene, std::string variant)
      : gl_(gl), scene_(scene), variant_(std::move(variant)) {}

  /// Blends the volumes into the image, the farthest first. The block `Frame` must be the scene's, `depth`
  /// the range of its depth buffer. Leaves its own framebuffer bound, which reads as the scene's.
  void draw(std::span<const WaterVolume> volumes, const Camera& camera, const DepthRange& depth);

 private:
  void create();
  void drawVolume(const WaterVolume& volume, const Camera& camera, const DepthRange& depth) const;
  void limitTo(const WaterVolume& volume, const Camera& camera) const;

  const GlFunctions& gl_;
  Scene scene_;
  std::string variant_;
  GLuint program_ = 0;
  GLuint target_ = 0;
  GLuint no_attributes_ = 0;
  GLuint block_buffer_ = 0;
};

}  // namespace carom::renderer
