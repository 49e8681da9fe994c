#pragma once
// The depths that the sun sees, drawn from all that casts shadows. Tested through the frames of
// tests/renderer/frame/frame_renderer_test.cpp.

#include <span>

#include "renderer/draw/draw_list.h"
#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

class ShadowMap {
 public:
  /// `texels` along either side. `gl` must outlive this.
  ShadowMap(const GlFunctions& gl, int texels);

  bool isComplete() const { return complete_; }
  GLuint texture() const { return texture_; }

  /// Draws each block anew, of the instances that are uploaded; what is outside of all stays.
  void draw(std::span<const BlockGroups> blocks, const SceneGeometry& geometry) const;

 private:
  const GlFunctions& gl_;
  int texels_;
  GLuint program_ = 0, glass_program_ = 0, texture_ = 0, target_ = 0;
  bool complete_ = false;
};

}  // namespace carom::renderer
