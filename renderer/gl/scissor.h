#pragma once
// Drawing within a block of pixels only. Tested through the frames of
// tests/renderer/frame/frame_renderer_test.cpp.

#include "renderer/gl/gl_functions.h"
#include "renderer/image/grid_cover.h"

namespace carom::renderer {

inline void setScissor(const GlFunctions& gl, const GridBlock& block) {
  gl.Scissor(block.x_begin, block.y_begin, block.x_end - block.x_begin, block.y_end - block.y_begin);
}

}  // namespace carom::renderer
