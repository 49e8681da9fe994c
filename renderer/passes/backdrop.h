#pragma once
// What stands behind the bodies: sky and the endless ground. In full sunlight it depends on the camera and
// the light alone, so that it is drawn once and copied under frame after frame while they stand still; the
// ground's shadows are drawn over it. Tested through the frames of
// tests/renderer/frame/frame_renderer_test.cpp.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/draw/frame_inputs.h"
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

  /// Fills those blocks of `target`, of the same size, with colours and depths; with or without ground. The
  /// inputs' block must be what the uniform block `Frame` holds, and what the ground mirrors be bound.
  void copyTo(GLuint target, const FrameInputs& inputs, std::span<const GridBlock> blocks);

  /// Draws the ground again where shadows may fall on it, into those blocks of the framebuffer that is bound,
  /// with the shadows of the map that is bound, wherever the ground is seen.
  void drawShadows(const FrameInputs& inputs, std::span<const GridBlock> blocks);

 private:
  struct Shown {
    FrameBlock block;
    bool with_ground;
    GroundPattern pattern;
  };
  struct GroundPrograms {
    GLuint open = 0, shadowed = 0;
  };
  void createTarget();
  void draw(const Shown& shown);
  const GroundPrograms& groundPrograms(GroundPattern pattern);

  const GlFunctions& gl_;
  Request request_;
  GLuint sky_program_ = 0;
  std::array<GroundPrograms, kGroundPatterns> ground_programs_;  // Linked when first needed.
  GLuint target_ = 0, no_attributes_ = 0, triangle_array_ = 0, triangle_buffer_ = 0;
  std::optional<Shown> shown_;
};

}  // namespace carom::renderer
