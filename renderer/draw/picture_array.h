#pragma once
// The pictures of all solids' surfaces as the layers of one texture: each is brought to one size, so that it
// repeats and gets smaller by itself, without the colours of another. What a picture shows from afar is the
// mean of its light, not of its bytes. Tested in tests/renderer/draw/picture_array_test.cpp and through the
// frames of tests/renderer/frame/surface_picture_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/solid/solid.h"
#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

/// A picture at half, a quarter, ... of its size: levels down to one pixel.
struct PictureLevels {
  std::vector<SurfacePicture> levels;
};

/// The picture with that size, and its levels. Sides are powers of two.
PictureLevels pictureLevels(const SurfacePicture& picture, int width, int height);

/// The size that all layers get: the next powers of two to the largest picture's sides, within a bound, and
/// less where that many layers would take more than 128 MB.
struct PictureSize {
  int width = 1;
  int height = 1;
};
PictureSize layerSize(std::span<const SurfacePicture> pictures);

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
