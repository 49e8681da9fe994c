#include "demos/figure/figure_manifold.h"

#include <array>
#include <numbers>

#include "demos/format/formatted.h"
#include "demos/overlay/overlay_frame.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

constexpr double kTilt = 1.6e-3;    // Radians about the upper slab's width.
constexpr double kHeading = 0.42;   // Radians about z.
constexpr double kLowest_m = 3e-4;  // The gap under the slab's lower end.

double faceBelow_m(const ManifoldFigure& figure) {
  return figure.X_WBelow.position.z() + 0.15;
}

// The lower face of the upper slab, in the world.
std::vector<Vec3> lowerFace(const ManifoldFigure& figure) {
  std::vector<Vec3> corners;
  for (const Vec2& c : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)})
    corners.push_back(figure.X_WAbove * Vec3(0.65 * c.x(), 0.31 * c.y(), -0.15));
  return corners;
}

void drawSide(renderer::Canvas& canvas, const ManifoldFigure& figure, const PageSize& size) {
  const double em = size.em();
  const Plot side = figure.side(size);
  side.drawAxes(canvas, {"along the upper slab in m", "gap in mm", 0.5, 1.0, 1, 0}, size);
  side.drawLevel(canvas, 1000.0 * figure.window.manifold, "F' (k)",
                 {{figure_color::kGreen}, 1.0 * size.line_px()}, size);
  const std::vector<Vec3> face = lowerFace(figure);
  const std::array<Vec2, 2> line = {figure.inSide(0.5 * (face[1] + face[2])),
                                    figure.inSide(0.5 * (face[0] + face[3]))};
  side.drawCurve(canvas, line, {{figure_color::kBlue}, 1.8 * size.line_px()});
  for (const PolygonCorner& corner : figure.polygon.corners) {
    const Vec2 p = figure.inSide(corner.p_W);
    canvas.disc(side.pixel(p.x(), 1000.0 * corner.gap_m), 2.2 * size.line_px(), {figure_color::kOrange});
  }
  canvas.text(side.rect().low + Vec2(0.0, -2.6 * em), "side view, heights enlarged",
              {0.85 * em, {figure_color::kInk}});
}

}  // namespace

Plot ManifoldFigure::side(const PageSize& size) const {
  const double em = size.em();
  return {
      {Vec2(0.73 * size.width, 5.5 * em), Vec2(size.width - 5.0 * em, 0.52 * captionTop(size) + 3.0 * em)},
      {-0.7, 0.7},
      {0.0, 2.2e3 * window.manifold}};
}

Vec2 ManifoldFigure::inSide(const Vec3& p_W) const {
  const Vec3 along = X_WAbove.rotation * Vec3::UnitX();
  return {along.dot(p_W - X_WAbove.position), 1000.0 * (p_W.z() - X_WBelow.position.z() - 0.15)};
}

ManifoldFigure manifoldFigure(const PageSize& size) {
  ManifoldFigure figure;
  figure.X_WBelow.position = Vec3(0.0, 0.0, 0.15);
  figure.X_WAbove.rotation = rotationBy(Vec3(0.0, 0.0, kHeading)) * rotationBy(Vec3(0.0, kTilt, 0.0));
  figure.X_WAbove.position = Vec3(0.25, -0.05, 0.3 + 0.15 + 0.65 * kTilt + kLowest_m);
  FeaturePair cold;
  const ConvexPart& a = figure.below.parts()[0];
  const ConvexPart& b = figure.above.parts()[0];
  figure.closest = closestFeatures(a, figure.X_WBelow, b, figure.X_WAbove, cold);
  figure.window = collisionWindow(a, b);
  figure.polygon = contactPolygon(figure.closest, a, figure.X_WBelow, b, figure.X_WAbove, figure.window);
  figure.manifold = contactManifold(figure.closest, {a, figure.X_WBelow, b, figure.X_WAbove}, figure.window);
  figure.camera = aboveCaption({{-1.1, -3.3, 3.4}, {0.5, 0.05, 0.2}, 33.0}, size);
  return figure;
}

renderer::Image drawManifoldFigure(const ManifoldFigure& figure, const PageSize& size) {
  const std::array<renderer::PictureSolid, 1> solids = {
      renderer::PictureSolid{&figure.below, figure.X_WBelow, figure_color::kStone}};
  const renderer::SolidPicture picture =
      renderer::castSolids(solids, figure.camera, size.width, size.height, figure_color::kPaper);
  renderer::Canvas canvas(picture.image);
  renderer::OverlayPainter painter(canvas, figure.camera, picture.depth);
  drawEdges(painter, solids, size);
  // The upper slab as glass, so that the face below it can be seen.
  const ConvexPolyhedron& above = figure.above.parts()[0].core;
  for (int e = 0; e < above.edgeCount(); ++e)
    painter.line(figure.X_WAbove * above.vertex(above.edge(e).tail),
                 figure.X_WAbove * above.vertex(above.edge(e).head),
                 {{figure_color::kBlue, 0.8}, 0.8 * size.line_px()});
  painter.area(lowerFace(figure), {figure_color::kBlue, 0.10});
  // The sides of the V-region of the face below.
  const double top = faceBelow_m(figure);
  for (int i = 0; i < 4; ++i) {
    constexpr std::array<int, 5> kX = {1, -1, -1, 1, 1}, kY = {1, 1, -1, -1, 1};
    const auto n = static_cast<std::size_t>(i);
    const Vec3 p(0.75 * kX[n], 0.6 * kY[n], top), q(0.75 * kX[n + 1], 0.6 * kY[n + 1], top);
    const Vec3 up(0.0, 0.0, 0.22);
    const std::array<Vec3, 4> side = {p, q, q + up, p + up};
    painter.area(side, {figure_color::kGreen, 0.10});
    painter.line(side, {{figure_color::kGreen, 0.8}, 0.6 * size.line_px()}, true);
  }
  std::vector<Vec3> corners;
  for (const PolygonCorner& corner : figure.polygon.corners) corners.push_back(corner.p_W);
  painter.area(corners, {figure_color::kOrange, 0.5});
  painter.line(corners, {{figure_color::kOrange}, 1.8 * size.line_px()}, true);
  for (const Vec3& corner : corners) painter.dot(corner, 2.2 * size.line_px(), {figure_color::kOrange});
  for (int i = 0; i < figure.manifold.count; ++i) {
    const ManifoldPoint& point = figure.manifold.points[static_cast<std::size_t>(i)];
    painter.dot(point.p_W, 3.0 * size.line_px(), {figure_color::kRed});
    painter.label(point.p_W,
                  std::string("P").append(std::to_string(i + 1)).append("  ").append(lengthText(point.gap_m)),
                  {0.95 * size.em(), {figure_color::kRed}, renderer::Align::kLeft, true, 0.9});
  }
  drawSide(canvas, figure, size);
  writeCaption(
      canvas,
      {"Figure 8. Multi-point collision",
       {"The upper slab's face, clipped by the V-region of the face F below (green) and by the plane F' at " +
            formatted("k = %.2f mm:", 1000.0 * figure.window.manifold),
        "a contact polygon of " + std::to_string(figure.polygon.corners.size()) +
            " corners (orange), of which the solver gets the " + std::to_string(figure.manifold.count) +
            " points P (red), each with its gap."}},
      size);
  return canvas.image();
}

}  // namespace carom::demos
