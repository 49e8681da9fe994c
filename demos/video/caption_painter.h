#pragma once
// Draws a frame's caption: white letters on a dark band near the lower edge, on one line or, where it would
// be too small to read, on two. Tested in tests/demos/video/caption_painter_test.cpp.

#include <string>

#include "renderer/image/image.h"

namespace carom::demos {

/// The image with the line over it; an empty line leaves it as it is.
renderer::Image withCaption(renderer::Image image, const std::string& line);

}  // namespace carom::demos
