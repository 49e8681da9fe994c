#pragma once
// Draws contact shadows: the triangles of contact_occlusion.h, multiplied into what is there. Tested through
// the frames of tests/renderer/frame/frame_renderer_test.cpp.

#include <span>
#include <string>
#include <vector>

#include "renderer/gl/gl_functions.h"
#include "renderer/image/grid_cover.h"
#include "renderer/mesh/contact_occlusion.h"

namespace carom::renderer {

/// What is drawn within a block of pixels.
struct BlockOcclusion {
  GridBlock block;
  std::vector<OcclusionTriangle> triangles;
};

class OcclusionPass {
 public:
  /// `lines` choose the variant of the shader. `gl` must outlive this.
  OcclusionPass(const GlFunctions& gl, const std::string& lines);

  /// Into the framebuffer that is bound, over its depths; nothing outside of the blocks.
  void draw(std::span<const BlockOcclusion> blocks) const;

 private:
  const GlFunctions& gl_;
  GLuint program_ = 0, vertex_array_ = 0, vertex_buffer_ = 0;
};

}  // namespace carom::renderer
