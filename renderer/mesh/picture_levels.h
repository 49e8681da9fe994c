#pragma once
// Pictures of solids' surfaces at the sizes in which they are looked up: all have one size, so that they are
// the layers of one texture, and smaller ones for what is far. What a picture shows from afar is the mean of
// its light, not of its bytes. Tested in tests/renderer/mesh/picture_levels_test.cpp.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/solid/solid.h"

namespace carom::renderer {

/// The picture with that many pixels: the mean of what each covers; between the nearest, around the picture,
/// where it gets larger.
SurfacePicture resizedPicture(const SurfacePicture& picture, int width, int height);

/// A picture at half, a quarter, ... of its size: levels down to one pixel.
struct PictureLevels {
  std::vector<SurfacePicture> levels;
};

/// The picture with that size, and its levels. Sides are powers of two.
PictureLevels pictureLevels(const SurfacePicture& picture, int width, int height);

/// What layers may take.
struct PictureBounds {
  int side = 2048;                             ///< Pixels; a power of two.
  std::size_t bytes = std::size_t{128} << 20;  ///< Of all layers, four bytes a pixel.
};

/// The size that all layers get: the next powers of two to the largest picture's sides, within the bounds,
/// and less where that many layers would take more bytes.
struct PictureSize {
  int width = 1;
  int height = 1;
};
PictureSize layerSize(std::span<const SurfacePicture> pictures, const PictureBounds& bounds = {});

}  // namespace carom::renderer
