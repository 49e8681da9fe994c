#pragma once
// Morphological anti-aliasing (Reshetov 2009) on the CPU: finds the stairs that a slanted edge makes on the
// pixel grid, lays the straight line through them that made them, and mixes the two sides by the area the
// line cuts off. Mixing is done in linear light. Two threads share the image in fixed halves, so that the
// result does not depend on how they are scheduled. Tested in tests/renderer/edge_filter_test.cpp.

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/image.h"

namespace carom::renderer {

class EdgeFilter {
 public:
  EdgeFilter(int width, int height);

  /// Filters `rgba` (width * height * 4 bytes, rows from bottom to top, as GL delivers them; alpha is
  /// ignored) into an image with rows from top to bottom.
  void apply(const std::vector<std::uint8_t>& rgba, Image& image);

 private:
  struct Band {
    int begin = 0;
    int end = 0;
  };
  void takeRows(const std::uint8_t* rgba, Image& image, Band rows, std::vector<std::uint8_t>& differs);
  void markRow(const std::uint8_t* rgba, int y, std::vector<std::uint8_t>& differs);
  void mixRowPairs(const std::uint8_t* rgba, Image& image, Band first_rows) const;
  void mixColumnPairs(const std::uint8_t* rgba, Image& image, Band first_columns) const;

  int width_;
  int height_;
  // Edges by pixel, top row first: bit kBelow where the pixel differs from the one below, kRight from the one
  // to the right. One row and one column of zeros around, so that neighbours can be read without a bounds
  // check.
  std::vector<std::uint8_t> edges_;
  std::array<std::vector<std::uint8_t>, 2> differs_;  // A row's flags by byte, for either thread.
};

}  // namespace carom::renderer
