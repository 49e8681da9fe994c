#pragma once
// The pictures that bodies are covered with as a page holds them: the layers of one texture, as the
// renderer's (renderer/mesh/picture_levels.h), but smaller where they would make the page too long. Read by
// web/pictures.js. Tested in tests/demos/page/page_pictures_test.cpp.

#include <vector>

#include "demos/page/byte_stream.h"
#include "engine/solid/solid.h"
#include "renderer/mesh/picture_levels.h"

namespace carom::demos {

class PagePictures {
 public:
  /// The layer of the picture, that of an equal one where there is one; -1 once there are kMostLayers.
  int add(const SurfacePicture& picture);
  /// The number of layers; where there are any, their width and height, and their red, green and blue bytes,
  /// layer by layer, each as what is left of it when what foretold() says is taken away, modulo 256.
  void write(ByteStream& out) const;

  static constexpr int kMostLayers = 256;  ///< Every WebGL 2 has as many.
  static constexpr renderer::PictureBounds kBounds = {1024, std::size_t{32} << 20};

 private:
  std::vector<SurfacePicture> pictures_;
};

/// A byte by those to the left of it, above it and above that on the left: along an edge across or down the
/// picture the one beside it, else as on a plane (Weinberger, Seroussi, Sapiro, The LOCO-I Lossless Image
/// Compression Algorithm, 2000, section III.A).
int foretold(int left, int above, int corner);

}  // namespace carom::demos
