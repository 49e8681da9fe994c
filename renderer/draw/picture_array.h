#pragma once
// The pictures of all solids' surfaces as the layers of one texture: each is brought to one size, so that it
// repeats and gets smaller by itself, without the colours of another. Tested through the frames of
// tests/renderer/frame/surface_picture_test.cpp.

#include <vector>

#include "engine/solid/solid.h"
#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

class PictureArray {
 public:
  /// The layer of the picture: that of an equal one where there is one.
  int add(const SurfacePicture& picture);
  bool empty() const { return pictures_.empty(); }
  /// Once, when all are added.
  void upload(const GlFunctions& gl);
  /// To the texture unit of the body shader's `pictures`.
  void bind(const GlFunctions& gl) const;

 private:
  std::vector<SurfacePicture> pictures_;
  GLuint texture_ = 0;
};

}  // namespace carom::renderer
