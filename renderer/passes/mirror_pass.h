#pragma once
// What the ground mirrors: bodies, where alpha is one. Half as fine as the image: the exposures blur it
// anyway. Tested through the frames of tests/renderer/view/preset_test.cpp.

#include <cstdint>
#include <span>

#include "renderer/draw/body_programs.h"
#include "renderer/draw/draw_list.h"
#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

class MirrorPass {
 public:
  /// For an image of that size. Both must outlive this. Throws NoImageMemory.
  MirrorPass(const GlFunctions& gl, BodyPrograms& programs, int width, int height);

  GLuint texture() const { return texture_; }
  std::int64_t texels() const { return std::int64_t{width_} * height_; }

  /// Draws the groups of the instances that are uploaded, and nothing else; the shadow map must be bound.
  void draw(std::span<const DrawGroup> groups, const SceneGeometry& geometry) const;

 private:
  const GlFunctions& gl_;
  BodyPrograms& programs_;
  GLuint texture_ = 0, target_ = 0;
  int width_, height_;
};

}  // namespace carom::renderer
