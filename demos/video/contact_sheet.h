#pragma once
// A contact sheet: moments of a run side by side in one picture, each with its time. Tested in
// tests/demos/video/moving_picture_test.cpp.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace carom::demos {

struct SheetShape {
  int columns = 0;
  int rows = 0;
  int pictures() const { return columns * rows; }
};
/// "4x3". Throws UsageError.
SheetShape readSheet(const std::string& text);

/// As many of the frames as there are places, evenly spread, the first and the last among them. Throws
/// UsageError where there are fewer.
std::vector<int> sheetFrames(const SheetShape& sheet, int frame_count);

class ContactSheet {
 public:
  /// Of pictures of one size.
  ContactSheet(const SheetShape& sheet, int width, int height);
  /// Width x height x 3 bytes of the next picture, which shows this time.
  void add(std::span<const std::uint8_t> rgb, double time_s);
  renderer::Image image() const;

  static constexpr int kGap_px = 4;

 private:
  SheetShape sheet_;
  int width_ = 0, height_ = 0;
  renderer::Image pictures_;
  std::vector<double> times_s_;
};

}  // namespace carom::demos
