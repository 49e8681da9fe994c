#pragma once
// What stands behind the bodies: sky and the endless ground. In full sunlight it depends on the camera and
// the light alone, so that it is drawn once and copied under frame after frame while they stand still; the
// ground's shadows are drawn over it. Tested through the frames of
// tests/renderer/frame/frame_renderer_test.cpp.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/draw/shaders.h"
#include "renderer/gl/gl_functions.h"
#include "renderer/image/grid_cover.h"
#include "renderer/view/shadow_cells.h"

namespace carom::renderer {

class Backdrop {
 public:
  struct Request {
    int width = 0;
    int height = 0;
    std::string variant;    ///< The lines that choose the programs (see shaders.h).
    bool polished = false;  ///< The ground mirrors bodies, so that no frame's backdrop serves another.
  };
  /// `gl` must outlive this.
  Backdrop(const GlFunctions& gl, const Request& request);

  /// Fills those blocks of `target`, of the same size, with colours and depths; with or without ground.
  /// `block` must be what the uniform block `Frame` holds, and what the ground mirrors be bound.
  void copyTo(GLuint target, const FrameBlock& block, bool with_ground, std::span<const GridBlock> blocks);

  /// Draws the ground again within `triangles`, into those blocks of the framebuffer that is bound, with the
  /// shadows of the map that is bound, wherever the ground is seen.
  void drawShadows(std::span<const GroundTriangle> triangles, std::span<const GridBlock> blocks);

 private:
  void createTarget();
  void draw(bool with_ground) const;

  struct Shown {
    FrameBlock block;
    bool with_ground;
  };
  const GlFunctions& gl_;
  Request request_;
  GLuint sky_program_ = 0, open_ground_program_ = 0, shadowed_ground_program_ = 0;
  GLuint target_ = 0, no_attributes_ = 0, triangle_array_ = 0, triangle_buffer_ = 0;
  std::optional<Shown> shown_;
};

}  // namespace carom::renderer
