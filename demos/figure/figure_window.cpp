#include "demos/figure/figure_window.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "demos/format/formatted.h"
#include "demos/overlay/overlay_frame.h"
#include "engine/closest_features/vclip.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "engine/simulation/world.h"

namespace carom::demos {
namespace {

constexpr double kStep_s = 1e-4;  // Of the run.
constexpr double kDuration_s = 0.02;
constexpr double kStart_m = 4.2e-3;  // The gap at the beginning.
constexpr double kFallSpeed_mps = 0.5;
constexpr double kHalf_m = 0.35;  // Of the cube's side.
const Vec3 kGravity(0.0, 0.0, -9.81);

// The floor of the window, the window, and what lies above, as bands of a plot.
void drawBands(renderer::Canvas& canvas, const WindowFigure& figure, const Plot& plot, const PlotRange& x) {
  const auto band = [&](double low_mm, double high_mm, const renderer::Color& color, double opacity) {
    const std::array<Vec2, 4> corners = {plot.pixel(x.low, low_mm), plot.pixel(x.high, low_mm),
                                         plot.pixel(x.high, high_mm), plot.pixel(x.low, high_mm)};
    canvas.fill(corners, {color, opacity});
  };
  band(0.0, 1e3 * figure.window.floor, figure_color::kRed, 0.18);
  band(1e3 * figure.window.floor, 1e3 * figure.window.ceiling, figure_color::kGreen, 0.14);
}

// The cube's outline about its lowest edge, at one instant; x = 0 is under that edge at the impulse.
void drawCubeCut(renderer::Canvas& canvas, const Plot& plot, const WindowFigure::Instant& instant,
                 double x_edge_m, const renderer::Stroke& stroke) {
  std::vector<Vec2> corners;  // of the cut through the middle, where y = 0
  for (const Vec2& c : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
    const Vec3 p = instant.X_WCube * Vec3(kHalf_m * c.x(), 0.0, kHalf_m * c.y());
    corners.emplace_back(1000.0 * (p.x() - x_edge_m), 1000.0 * p.z());
  }
  const auto lowest = std::min_element(corners.begin(), corners.end(),
                                       [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); });
  std::rotate(corners.begin(), lowest, corners.end());
  const std::array<Vec2, 3> shown = {corners[1], corners[0], corners[3]};
  plot.drawCurve(canvas, shown, stroke);
}

double lowestX(const Pose& X_WCube) {
  Vec3 lowest = X_WCube * Vec3(kHalf_m, 0.0, kHalf_m);
  for (const Vec2& c : {Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
    const Vec3 p = X_WCube * Vec3(kHalf_m * c.x(), 0.0, kHalf_m * c.y());
    if (p.z() < lowest.z()) lowest = p;
  }
  return lowest.x();
}

void drawWindowCut(renderer::Canvas& canvas, const WindowFigure& figure, const PageSize& size) {
  const Plot cut = figure.cut(size);
  const Vec2 middle = 0.5 * (cut.rect().low + cut.rect().high);
  const double zero_px = cut.pixel(0.0, 0.0).y();
  const std::array<Vec2, 4> plate = {Vec2(cut.rect().low.x(), zero_px), Vec2(cut.rect().high.x(), zero_px),
                                     cut.rect().high, Vec2(cut.rect().low.x(), cut.rect().high.y())};
  canvas.fill(plate, {figure_color::kStone});
  const double x_mm =
      (cut.rect().high.x() - middle.x()) / (cut.pixel(1.0, 0.0).x() - cut.pixel(0.0, 0.0).x());
  drawBands(canvas, figure, cut, {-x_mm, x_mm});
  const std::array<Vec2, 2> surface = {cut.pixel(-x_mm, 0.0), cut.pixel(x_mm, 0.0)};
  canvas.line(surface, {{figure_color::kInk}, 1.4 * size.line_px()});

  const auto solved = std::find_if(figure.run.begin(), figure.run.end(),
                                   [&](const auto& i) { return i.time_s + kStep_s > figure.impulse_s; });
  const double x_edge = lowestX(solved->X_WCube);
  for (auto i = figure.run.begin(); i < solved; i += 10)
    drawCubeCut(canvas, cut, *i, x_edge, {{figure_color::kBlue, 0.35}, 0.8 * size.line_px()});
  drawCubeCut(canvas, cut, *solved, x_edge, {{figure_color::kBlue}, 1.8 * size.line_px()});
  const double em = size.em();
  const auto name = [&](double gap_m, const char* text, const renderer::Color& color) {
    const Vec2 right = cut.pixel(x_mm, 1000.0 * gap_m);
    const std::array<Vec2, 2> ends = {cut.pixel(-x_mm, 1000.0 * gap_m), right};
    canvas.line(ends, {{color}, 0.7 * size.line_px()});
    canvas.text(right + Vec2(0.4 * em, 0.0), text, {em, {color}, renderer::Align::kLeft, true});
  };
  name(figure.window.floor, "ε₁", figure_color::kRed);
  name(figure.window.ceiling, "ε₂", figure_color::kGreen);
  canvas.text({middle.x(), cut.rect().high.y() + 1.0 * em}, "plate",
              {0.85 * em, {figure_color::kInk}, renderer::Align::kMiddle});
  canvas.text({cut.rect().low.x(), cut.rect().low.y() - 1.0 * em},
              "cut through the cube's edge, one line in ten steps", {0.85 * em, {figure_color::kInk}});
}

}  // namespace

Plot WindowFigure::plot(const PageSize& size) const {
  const double em = size.em();
  return {{Vec2(0.5 * size.width, 3.0 * em), Vec2(size.width - 6.0 * em, captionTop(size) - 3.2 * em)},
          {0.0, 1000.0 * run.back().time_s},
          {0.0, 3e3 * window.ceiling}};
}

Plot WindowFigure::cut(const PageSize& size) const {
  const double em = size.em();
  const double high = 3e3 * window.ceiling, low = -0.35e3 * window.ceiling;
  const renderer::PixelRect rect{Vec2(4.5 * em, 3.0 * em),
                                 Vec2(0.5 * size.width - 5.0 * em, captionTop(size) - 3.2 * em)};
  const double wide = (high - low) * (rect.high.x() - rect.low.x()) / (rect.high.y() - rect.low.y());
  return {rect, {-0.5 * wide, 0.5 * wide}, {low, high}};
}

WindowFigure windowFigure() {
  constexpr double kTurn = 40.0 * std::numbers::pi / 180.0;
  WindowFigure figure;
  World world({kStep_s, kGravity, true});
  BodyDescription plate{
      world.addSolid(Solid::box({4.0, 4.0, 1.0})), {}, Vec3::Zero(), Vec3::Zero(), {}, true};
  plate.X_WB.position = Vec3(0.0, 0.0, -0.5);
  BodyDescription cube{world.addSolid(figure.cube), {}, Vec3::Zero(), Vec3::Zero(), {}, false};
  cube.X_WB.rotation = rotationBy(Vec3(0.0, kTurn, 0.0));
  const SineCosine turn = sineCosine(kTurn);
  cube.X_WB.position = Vec3(0.0, 0.0, kHalf_m * (turn.sine + turn.cosine) + kStart_m);
  cube.linear_velocity = Vec3(0.0, 0.0, -kFallSpeed_mps);
  cube.material.restitution = 0.5;
  cube.material.static_friction = cube.material.dynamic_friction = 0.0;
  world.addBody(plate);
  world.addBody(cube);
  REQUIRE(world.start().empty());
  const ConvexPart& plate_part = world.solids()[0].parts()[0];
  const ConvexPart& cube_part = figure.cube.parts()[0];
  figure.window = collisionWindow(plate_part, cube_part);
  StepView view;
  world.watch(&view);
  FeaturePair tracked;
  while (world.time() < kDuration_s) {
    const Pose& X_WCube = world.states()[1].X_WB;
    const double gap =
        closestFeatures(plate_part, world.states()[0].X_WB, cube_part, X_WCube, tracked).distance_m;
    figure.run.push_back({world.time(), gap, X_WCube});
    world.step();
  }
  REQUIRE(!view.collisions.empty());
  figure.impulse_s = view.collisions.front().time_s;
  figure.impulse_gap_m = view.collisions.front().gap_m;
  for (const ContactView& contact : view.collisions)
    if (contact.time_s == figure.impulse_s) figure.impulse_Ns += contact.impulse_W.norm();
  return figure;
}

renderer::Image drawWindowFigure(const WindowFigure& figure, const PageSize& size) {
  renderer::Canvas canvas(size.width, size.height, figure_color::kPaper);
  drawWindowCut(canvas, figure, size);
  const Plot plot = figure.plot(size);
  drawBands(canvas, figure, plot, {0.0, 1000.0 * figure.run.back().time_s});
  plot.drawAxes(canvas, {"t in ms", "d(t) in mm", 5.0, 1.0, 0, 0}, size);
  const CollisionWindow& w = figure.window;
  plot.drawLevel(canvas, 1000.0 * w.floor, "ε₁", {{figure_color::kRed}, 0.7 * size.line_px()}, size);
  plot.drawLevel(canvas, 1000.0 * w.rest, "rest", {{figure_color::kFaint}, 0.5 * size.line_px(), 4.0}, size);
  plot.drawLevel(canvas, 1000.0 * w.ceiling, "ε₂", {{figure_color::kGreen}, 0.7 * size.line_px()}, size);
  std::vector<Vec2> curve;
  for (const WindowFigure::Instant& i : figure.run) curve.emplace_back(1000.0 * i.time_s, 1000.0 * i.gap_m);
  plot.drawCurve(canvas, curve, {{figure_color::kBlue}, 1.8 * size.line_px()});
  const Vec2 at = plot.pixel(1000.0 * figure.impulse_s, 1000.0 * figure.impulse_gap_m);
  canvas.disc(at, 2.6 * size.line_px(), {figure_color::kRed});
  canvas.text(at + Vec2(0.9 * size.em(), 0.2 * size.em()), "impulse",
              {size.em(), {figure_color::kRed}, renderer::Align::kLeft, true, 0.9});
  writeCaption(
      canvas,
      {"Figure 7. The collision window",
       {formatted("ε₁ = %.3f mm, ", 1000.0 * w.floor) + formatted("ε₂ = %.3f mm: ", 1000.0 * w.ceiling) +
            "between them a collision is solved directly, below ε₁ no two bodies ever get.",
        formatted("A cube's edge comes down on a plate at %.2g m/s: ", kFallSpeed_mps) +
            formatted("the impulse of %.3g N s ", figure.impulse_Ns) +
            formatted("acts at t = %.3f ms, ", 1000.0 * figure.impulse_s) +
            formatted("d = %.3f mm.", 1000.0 * figure.impulse_gap_m)}},
      size);
  return canvas.image();
}

}  // namespace carom::demos
