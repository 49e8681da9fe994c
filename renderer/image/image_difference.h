#pragma once
// How far two images are apart, sample by sample: the figures a gate decides by, and a picture of where. A
// shift of a hair's breadth moves few pixels by much, so the gate is the largest difference of any channel,
// not a mean. Pure: reads two rasters, touches no file. Tested in
// tests/renderer/image/image_difference_test.cpp, and against OpenImageIO's idiff in
// tests/renderer/image/idiff_agreement_test.cpp.

#include <cstdint>
#include <string>

#include "renderer/image/image.h"
#include "renderer/image/raster.h"

namespace carom::renderer {

/// Side of the squares among which the worst is sought, in pixels.
inline constexpr int kTileSide = 32;

struct Tile {
  int x = 0;  ///< Of its upper left pixel.
  int y = 0;
  int width = 0;  ///< Less than kTileSide at the right and lower edge.
  int height = 0;
  std::int64_t pixels_beyond = 0;
};

/// Differences are in steps of 1 / full_scale.
struct ImageDifference {
  int full_scale = 255;
  int largest = 0;    ///< Of any channel of any pixel.
  int largest_x = 0;  ///< The first such pixel, in reading order.
  int largest_y = 0;
  std::string largest_channel;  ///< "grey", "red", "green", "blue", "alpha"; empty without a difference.
  std::int64_t pixels_different = 0;  ///< With any difference at all.
  std::int64_t pixels_beyond = 0;     ///< With a channel that differs by more than the tolerance.
  double mean = 0.0;                  ///< Over all channels of all pixels.
  Tile worst_tile;                    ///< The most pixels beyond, then the largest sum, then the first.
};

/// True when pixels can be compared one by one: the same width, height and bits. Grey against RGB, and opaque
/// against no alpha, can: the narrower one is widened.
bool comparable(const Raster& a, const Raster& b);

/// `a` with the channels that it and `b` are compared in: grey becomes three equal ones where either has
/// colours, no alpha opaque where either has it.
Raster inCommonChannels(const Raster& a, const Raster& b);

/// "640x360 16-bit grey"
std::string shapeText(const RasterShape& shape);

/// REQUIRES comparable(a, b). `tolerance` is in steps of 1 / full scale.
ImageDifference differenceOf(const Raster& a, const Raster& b, int tolerance);

struct DifferencePicture {
  int tolerance = 0;
  int amplify = 16;
};

/// |a - b| * amplify, channel by channel, clamped, as 8-bit RGB on black; a difference in alpha counts for
/// all three. A pixel beyond the tolerance is at least a third bright, whatever the factor. REQUIRES
/// comparable(a, b).
Image differenceImage(const Raster& a, const Raster& b, const DifferencePicture& how);

}  // namespace carom::renderer
