#pragma once
// Pictures with alpha: from what is drawn over nothing, whose colours are multiplied by their coverage, to
// what files hold, whose colours are not. Tested in tests/renderer/image/cutout_test.cpp.

#include "renderer/image/image.h"
#include "renderer/image/raster.h"

namespace carom::renderer {

/// Divides the light of each pixel by its alpha.
void unmultiply(Image& image);

/// Colours and alpha as four channels, and back.
Raster rasterOf(const Image& image);
Image imageOf(const Raster& raster);

}  // namespace carom::renderer
