#include "demos/figure/figure_page.h"

#include <array>

#include "demos/format/formatted.h"

namespace carom::demos {
namespace {

constexpr double kCaptionRows = 6.4;  // Ems from the caption's top to the foot of the page.
constexpr double kRow = 1.35;

}  // namespace

double captionTop(const PageSize& size) {
  return size.height - kCaptionRows * size.em();
}

void writeCaption(renderer::Canvas& canvas, const Caption& caption, const PageSize& size) {
  const double em = size.em(), left = 1.5 * em;
  const std::array<Vec2, 2> rule = {Vec2(left, captionTop(size)), Vec2(size.width - left, captionTop(size))};
  const Vec2 foot(size.width, size.height);
  const std::array<Vec2, 4> paper = {Vec2(0.0, captionTop(size)), Vec2(foot.x(), captionTop(size)), foot,
                                     Vec2(0.0, foot.y())};
  canvas.fill(paper, {figure_color::kPaper});
  canvas.line(rule, {{figure_color::kFaint, 0.5}, 0.5 * size.line_px()});
  Vec2 at(left, captionTop(size) + 1.0 * em);
  canvas.text(at, caption.title, {1.1 * em, {figure_color::kInk}, renderer::Align::kLeft, true});
  for (const std::string& words : caption.lines) {
    at.y() += kRow * em;
    canvas.text(at, words, {0.9 * em, {figure_color::kInk}});
  }
}

renderer::Camera aboveCaption(renderer::Camera camera, const PageSize& size) {
  const renderer::CameraAxes axes = renderer::cameraAxes(camera);
  const double distance = (camera.target - camera.eye).norm();
  const double pixels = 0.5 * (size.height - captionTop(size));
  const Vec3 down = -pixels * distance / renderer::focalLengthPixels(camera, size.height) * axes.up;
  camera.eye += down;
  camera.target += down;
  return camera;
}

void drawEdges(renderer::OverlayPainter& painter, std::span<const renderer::PictureSolid> solids,
               const PageSize& size) {
  for (const renderer::PictureSolid& solid : solids)
    for (const ConvexPart& part : solid.solid->parts())
      for (int e = 0; e < part.core.edgeCount(); ++e) {
        const Edge& edge = part.core.edge(e);
        painter.line(solid.X_WB * part.core.vertex(edge.tail), solid.X_WB * part.core.vertex(edge.head),
                     {{figure_color::kInk, 0.85}, 0.7 * size.line_px()});
      }
}

std::string decimalText(double value, int digits) {
  const std::string shown = formatted("%.*f", digits, value);
  const bool zero = shown.find_first_not_of("-0.") == std::string::npos;
  return zero && shown[0] == '-' ? shown.substr(1) : shown;
}

std::string vectorText(const Vec3& v) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < 3; ++i) text.append(i > 0 ? ", " : "").append(decimalText(v[i], 2));
  return text.append(")");
}

}  // namespace carom::demos
