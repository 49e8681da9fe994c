#pragma once
// Draws glass over what is behind it: the farthest first, each over a copy of the image as it is by then.
// Tested in tests/renderer/frame/look_frames_test.cpp.

#include <span>
#include <string>

#include "renderer/draw/draw_list.h"
#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

class GlassPass {
 public:
  struct Scene {
    GLuint target = 0;
    int width = 0;
    int height = 0;
  };
  /// `lines` choose the variant of the shader. `gl` must outlive this; nothing is made before glass is drawn.
  GlassPass(const GlFunctions& gl, const Scene& scene, std::string lines);

  /// Into the scene's target, over its depths, which it adds to; groups of the instances that are uploaded,
  /// and the shadow map must be bound. Throws NoImageMemory.
  void draw(std::span<const DrawGroup> groups, const SceneGeometry& geometry);

 private:
  void create();
  void copyScene() const;

  const GlFunctions& gl_;
  Scene scene_;
  std::string lines_;
  GLuint program_ = 0, texture_ = 0, copy_ = 0;
};

}  // namespace carom::renderer
