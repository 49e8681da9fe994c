#pragma once
// Drawing in the plane over an image: lines, areas, discs and text, anti-aliased, by Cairo; canvas.cpp is the
// only file that names it. Coordinates are those of projection.h: pixels from the top left corner, y down.
// The same calls give the same bytes. Tested in tests/renderer/drawing/canvas_test.cpp.

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "engine/foundation/frames.h"
#include "renderer/image/color.h"
#include "renderer/image/image.h"
#include "renderer/view/view.h"

namespace carom::renderer {

struct Ink {
  Color color;
  double opacity = 1.0;  ///< 0 to 1.
};

struct Stroke {
  Ink ink;
  double width_px = 1.5;
  double dash_px = 0.0;  ///< Length of dashes and of the gaps between them; 0: one line.
  double halo = 0.0;     ///< Opacity of a white border that sets the line off from what is behind it.
};

enum class Align : std::uint8_t { kLeft, kMiddle, kRight };

struct TextStyle {
  double size_px = 14.0;  ///< Of the em square.
  Ink ink;
  Align align = Align::kLeft;
  bool bold = false;
  double halo = 0.0;  ///< As of a stroke.
};

/// What part of an area's opacity the pixel (x, y) gets, 0 to 1.
using PixelShare = std::function<double(int x, int y)>;

class Canvas {
 public:
  Canvas(int width, int height, const Color& background);
  /// Starts from a copy of the image.
  explicit Canvas(const Image& image);
  ~Canvas();
  Canvas(Canvas&&) noexcept;
  Canvas& operator=(Canvas&&) noexcept;

  int width() const;
  int height() const;

  /// Through two points or more, with round ends and corners.
  void line(std::span<const Vec2> points, const Stroke& stroke, bool closed = false);
  void fill(std::span<const Vec2> outline, const Ink& ink);
  void fill(std::span<const Vec2> outline, const Ink& ink, const PixelShare& share);
  void disc(const Vec2& center, double radius_px, const Ink& ink);
  /// One line of UTF-8 in DejaVu Sans; capital letters stand centred on `at`'s height.
  void text(const Vec2& at, const std::string& words, const TextStyle& style);
  /// How far a text reaches to the right, pixels.
  double textWidth(const std::string& words, const TextStyle& style) const;

  Image image() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom::renderer
