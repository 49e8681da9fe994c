#include "demos/video/caption_painter.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "engine/foundation/elementary.h"
#include "renderer/drawing/canvas.h"

namespace carom::demos {
namespace {

using renderer::Canvas;
using renderer::TextStyle;

constexpr renderer::Color kPaper = {0.08f, 0.09f, 0.11f};
constexpr double kPaperOpacity = 0.72;
constexpr renderer::Color kLetters = {1.0f, 1.0f, 1.0f};
constexpr double kUsualSize = 1.0 / 27.0;  // Of the image's height: that of letters.
constexpr double kSmallestUsual_px = 9.5;  // Letters of this size are legible in the smallest frames, too.
constexpr double kSmallestShare = 0.8;     // Of the usual size, before the line is broken in two.
constexpr double kSide = 0.03;             // Of the image's width, left free on both sides of the band.
constexpr double kPadding = 0.9;           // In ems: left free within the band on both sides.
constexpr double kBand = 1.75;             // In ems: the height of a band of one line.
constexpr double kRow = 1.35;              // In ems: what each further line adds to the band's height.
constexpr double kBelow = 0.7;             // In ems: left free below the band.
constexpr double kCorner = 0.45;           // In ems: the radius of the band's corners.

/// The blank nearest to the middle, before wider gaps than one where there are some.
std::array<std::string, 2> brokenInTwo(const std::string& line) {
  for (const char* gap : {"   ", "  ", " "}) {
    std::size_t best = std::string::npos, distance = line.size();
    for (std::size_t at = line.find(gap); at != std::string::npos; at = line.find(gap, at + 1)) {
      const std::size_t from_middle = at > line.size() / 2 ? at - line.size() / 2 : line.size() / 2 - at;
      if (from_middle < distance) {
        best = at;
        distance = from_middle;
      }
    }
    if (best == std::string::npos || distance > line.size() / 4) continue;
    const std::size_t next = line.find_first_not_of(' ', best);
    if (next != std::string::npos) return {line.substr(0, best), line.substr(next)};
  }
  return {line, ""};
}

double widest(const Canvas& canvas, const std::vector<std::string>& lines, const TextStyle& style) {
  double width = 0.0;
  for (const std::string& line : lines) width = std::max(width, canvas.textWidth(line, style));
  return width;
}

/// How far it has to shrink to be so wide.
double shrunk(double width, double room) {
  return width > room ? room / width : 1.0;
}

/// The outline of a rectangle with round corners.
std::vector<Vec2> roundedBand(const Vec2& center, const Vec2& half, double radius) {
  constexpr int kSteps = 8;  // Of a quarter of a circle.
  std::vector<Vec2> outline;
  for (int i = 0; i < 4 * (kSteps + 1); ++i) {
    const int corner = i / (kSteps + 1);
    const SineCosine angle =
        sineCosine(0.5 * std::numbers::pi * (corner + static_cast<double>(i % (kSteps + 1)) / kSteps));
    const Vec2 side(corner == 0 || corner == 3 ? 1.0 : -1.0, corner < 2 ? 1.0 : -1.0);
    outline.push_back(center + side.cwiseProduct(half - Vec2::Constant(radius)) +
                      radius * Vec2(angle.cosine, angle.sine));
  }
  return outline;
}

}  // namespace

renderer::Image withCaption(renderer::Image image, const std::string& line) {
  if (line.find_first_not_of(' ') == std::string::npos) return image;
  Canvas canvas(image);
  TextStyle style{
      std::max(kUsualSize * image.height, kSmallestUsual_px), {kLetters}, renderer::Align::kMiddle};
  const double room = (1.0 - 2.0 * kSide) * image.width - 2.0 * kPadding * style.size_px;
  std::vector<std::string> lines{line};
  if (shrunk(widest(canvas, lines, style), room) < kSmallestShare) {
    const auto [first, second] = brokenInTwo(line);
    lines = second.empty() ? lines : std::vector<std::string>{first, second};
  }
  style.size_px *= shrunk(widest(canvas, lines, style), room);

  const double em = style.size_px, rows = static_cast<double>(lines.size());
  const double height = em * (kBand + kRow * (rows - 1.0));
  const double width = widest(canvas, lines, style) + 2.0 * kPadding * em;
  const double bottom = image.height - kBelow * em, middle = 0.5 * image.width;
  canvas.fill(roundedBand({middle, bottom - 0.5 * height}, {0.5 * width, 0.5 * height}, kCorner * em),
              {kPaper, kPaperOpacity});
  for (std::size_t i = 0; i < lines.size(); ++i)
    canvas.text({middle, bottom - 0.5 * kBand * em - kRow * em * (rows - 1.0 - static_cast<double>(i))},
                lines[i], style);
  return canvas.image();
}

}  // namespace carom::demos
