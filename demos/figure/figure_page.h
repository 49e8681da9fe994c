#pragma once
// A page for a figure of the paper: white, the picture above, title and caption below, at any size; and the
// marks that figures share. Tested in tests/demos/figure/figures_test.cpp.

#include <string>
#include <vector>

#include "renderer/drawing/overlay_painter.h"
#include "renderer/drawing/solid_picture.h"

namespace carom::demos {

struct PageSize {
  int width = 1280;
  int height = 720;
  /// Of text, pixels.
  double em() const { return height / 34.0; }
  double line_px() const { return height / 360.0; }
};

namespace figure_color {
inline constexpr renderer::Color kPaper = {1.0f, 1.0f, 1.0f};
inline constexpr renderer::Color kInk = {0.10f, 0.11f, 0.13f};
inline constexpr renderer::Color kFaint = {0.55f, 0.57f, 0.60f};
inline constexpr renderer::Color kStone = {0.83f, 0.85f, 0.88f};
inline constexpr renderer::Color kSand = {0.97f, 0.88f, 0.72f};
inline constexpr renderer::Color kBlue = {0.00f, 0.38f, 0.68f};
inline constexpr renderer::Color kGreen = {0.00f, 0.55f, 0.38f};
inline constexpr renderer::Color kOrange = {0.88f, 0.48f, 0.00f};
inline constexpr renderer::Color kRed = {0.78f, 0.16f, 0.05f};
inline constexpr renderer::Color kPurple = {0.58f, 0.20f, 0.52f};
}  // namespace figure_color

/// What stands below a picture.
struct Caption {
  std::string title;               ///< "Figure 2. Vertex–face collision"
  std::vector<std::string> lines;  ///< Up to three.
};
void writeCaption(renderer::Canvas& canvas, const Caption& caption, const PageSize& size);

/// Height above which the caption does not reach, pixels.
double captionTop(const PageSize& size);

/// The camera moved so that what it looks at stands in the middle of the part above the caption.
renderer::Camera aboveCaption(renderer::Camera camera, const PageSize& size);

/// The edges of solids; hidden ones faint and dashed.
void drawEdges(renderer::OverlayPainter& painter, std::span<const renderer::PictureSolid> solids,
               const PageSize& size);

/// "0.50"; a zero has no sign.
std::string decimalText(double value, int digits);
/// "(0.00, 0.00, 1.00)".
std::string vectorText(const Vec3& v);

}  // namespace carom::demos
