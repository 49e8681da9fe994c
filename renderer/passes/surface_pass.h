#pragma once
// Computes surface images: flat parts of solids through GL with unbevelled faces into float targets, the
// endless ground and rounded parts in closed form on the CPU. Tested in
// tests/renderer/image/surface_image_test.cpp.

#include <span>
#include <vector>

#include "renderer/draw/draw_list.h"
#include "renderer/draw/scene_geometry.h"
#include "renderer/gl/gl_functions.h"
#include "renderer/image/surface_image.h"

namespace carom::renderer {

class SurfacePass {
 public:
  struct Size {
    int width = 0;
    int height = 0;
  };
  /// Links its program; the targets are made at the first `draw`. `gl` must outlive this and be current here
  /// and in `draw`.
  SurfacePass(const GlFunctions& gl, const Size& size) : gl_(gl), size_(size) {}

  /// The block `Frame` must be that of the unshifted camera.
  void draw(std::span<const Instance> instances, std::span<const Solid> solids, const Camera& camera,
            const DrawList& list, const SceneGeometry& geometry, SurfaceImage& surfaces);

 private:
  void createTargets();
  void drawFlatParts(std::span<const Instance> instances, const Camera& camera, const SceneGeometry& geometry,
                     int ground);
  void startWithGround(const Camera& camera, const DrawList& list, SurfaceImage& surfaces) const;
  void takeFlatParts(SurfaceImage& surfaces);

  const GlFunctions& gl_;
  Size size_;
  GLuint program_ = 0;
  GLuint target_ = 0;
  std::vector<float> normals_and_depths_;  // Four a pixel, bottom row first.
  std::vector<float> ids_;                 // One a pixel: instance + 1.
};

}  // namespace carom::renderer
