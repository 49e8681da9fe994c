#include "demos/figure/figure_support.h"

#include <array>

#include "demos/format/formatted.h"
#include "demos/overlay/overlay_frame.h"
#include "engine/foundation/contract.h"
#include "engine/modes/support_polygon.h"

namespace carom::demos {
namespace {

constexpr int kMostSteps = 960;
constexpr int kTable = 1;

ConvexPart boxAt(const Vec3& size_m, const Vec3& middle) {
  return {boxPolyhedron(size_m).translated(middle), 0.0};
}

// A slab on three legs; the legs stand apart unevenly.
Solid tableSolid() {
  const Vec3 leg(0.12, 0.12, 0.6);
  return Solid({boxAt({1.3, 0.9, 0.1}, {0.0, 0.0, 0.65}), boxAt(leg, {-0.52, -0.34, 0.3}),
                boxAt(leg, {0.56, -0.2, 0.3}), boxAt(leg, {-0.1, 0.36, 0.3})});
}

void findSupport(SupportFigure& figure, const StepView& view) {
  const Vec3 down = figure.world.settings().gravity.normalized();
  const TangentBasis plane = tangentBasis(down);
  const auto project = [&](const Vec3& p) { return Vec2(plane.t1.dot(p), plane.t2.dot(p)); };
  std::vector<Vec2> points;
  double level = 0.0;
  for (const ContactView& contact : view.lasting) {
    const Vec3 p_W = figure.world.states()[kTable].X_WB * contact.p_B;
    figure.points_W.push_back(p_W);
    points.push_back(project(p_W));
    level += p_W.dot(down) / static_cast<double>(view.lasting.size());
  }
  const std::vector<Vec2> cover = convexCover(points);
  const auto place = [&](const Vec2& p) { return Vec3(p.x() * plane.t1 + p.y() * plane.t2 + level * down); };
  for (const Vec2& p : cover) figure.cover_W.push_back(place(p));
  figure.center_W = figure.world.states()[kTable].X_WB.position;
  figure.foot_W = place(project(figure.center_W));
  figure.outside_m = distanceOutside(cover, project(figure.center_W));
}

std::string restText(const SupportFigure& figure) {
  return formatted("at rest since t = %.2f s; ", figure.rest_s) + std::to_string(figure.points_W.size()) +
         " points of contact, a cover of " + std::to_string(figure.cover_W.size()) + " corners; " +
         (figure.outside_m == 0.0 ? std::string("the projection lies inside.")
                                  : "the projection misses it by " + lengthText(figure.outside_m) + ".");
}

}  // namespace

Plot SupportFigure::plan(const PageSize& size) const {
  const double em = size.em();
  const renderer::PixelRect rect{Vec2(5.0 * em, 3.0 * em),
                                 Vec2(size.width - 4.0 * em, captionTop(size) - 3.2 * em)};
  const double half_y = 0.55;
  const double half_x = half_y * (rect.high.x() - rect.low.x()) / (rect.high.y() - rect.low.y());
  return {rect, {-half_x, half_x}, {-half_y, half_y}};
}

SupportFigure supportFigure(const PageSize& size) {
  SupportFigure figure;
  BodyDescription floor{
      figure.world.addSolid(Solid::box({2.6, 2.0, 0.12})), {}, Vec3::Zero(), Vec3::Zero(), {}, true};
  floor.X_WB.position = Vec3(0.0, 0.0, -0.06);
  const Solid table = tableSolid();
  BodyDescription standing{figure.world.addSolid(table), {}, Vec3::Zero(), Vec3::Zero(), {}, false};
  standing.X_WB.position = Vec3(0.0, 0.0, 0.02) - table.origin_B();
  figure.world.addBody(floor);
  figure.world.addBody(standing);
  REQUIRE(figure.world.start().empty());
  StepView view;
  figure.world.watch(&view);
  while (figure.world.states()[kTable].mode != Mode::kResting && figure.world.stepCount() < kMostSteps)
    figure.world.step();
  REQUIRE(figure.world.states()[kTable].mode == Mode::kResting);
  figure.rest_s = figure.world.time();
  figure.world.watch(nullptr);
  findSupport(figure, view);
  figure.camera = aboveCaption({{2.3, -3.9, 1.85}, {0.0, 0.0, 0.15}, 30.0}, size);
  return figure;
}

renderer::Image drawSupportFigure(const SupportFigure& figure, const PageSize& size) {
  const World& world = figure.world;
  const std::array<renderer::PictureSolid, 2> solids = {
      renderer::PictureSolid{&world.solids()[0], world.states()[0].X_WB, figure_color::kStone},
      renderer::PictureSolid{&world.solids()[1], world.states()[kTable].X_WB, figure_color::kSand}};
  const renderer::SolidPicture picture =
      renderer::castSolids(solids, figure.camera, size.width, size.height, figure_color::kPaper);
  renderer::Canvas canvas(picture.image);
  renderer::OverlayPainter painter(canvas, figure.camera, picture.depth);
  drawEdges(painter, solids, size);
  const renderer::TextStyle style{size.em(), {figure_color::kInk}, renderer::Align::kLeft, true, 0.9};
  painter.area(figure.cover_W, {figure_color::kGreen, 0.35});
  painter.line(figure.cover_W, {{figure_color::kGreen}, 1.8 * size.line_px()}, true);
  for (const Vec3& p : figure.points_W) painter.dot(p, 1.8 * size.line_px(), {figure_color::kOrange});
  painter.setLift(2.0 * world.solids()[1].radius());  // the centre of mass is shown through the slab
  painter.arrow(figure.center_W, figure.foot_W, {{figure_color::kRed}, 1.8 * size.line_px(), 0.0, 0.8});
  painter.dot(figure.center_W, 2.8 * size.line_px(), {figure_color::kRed});
  painter.dot(figure.foot_W, 2.2 * size.line_px(), {figure_color::kRed});
  painter.label(figure.center_W, "centre of mass", style);
  painter.label(figure.foot_W, "its projection along gravity", style);
  painter.setLift(0.0);
  writeCaption(canvas,
               {"Figure 9. Resting: the support polygon",
                {"The points of contact (orange), their convex cover (green), and the projection of the "
                 "centre of mass in",
                 "the direction of gravity (red). A table on three legs:", restText(figure)}},
               size);
  return canvas.image();
}

renderer::Image drawSupportPlan(const SupportFigure& figure, const PageSize& size) {
  renderer::Canvas canvas(size.width, size.height, figure_color::kPaper);
  const Plot plan = figure.plan(size);
  plan.drawAxes(canvas, {"x in m", "y in m", 0.2, 0.2, 1, 1}, size);
  const auto at = [&](const Vec3& p) { return plan.pixel(p.x(), p.y()); };
  std::vector<Vec2> cover;
  for (const Vec3& p : figure.cover_W) cover.push_back(at(p));
  canvas.fill(cover, {figure_color::kGreen, 0.25});
  canvas.line(cover, {{figure_color::kGreen}, 1.8 * size.line_px()}, true);
  // The table's outline and its legs, as thin lines.
  const Solid& table = figure.world.solids()[1];
  const Pose& X_WTable = figure.world.states()[kTable].X_WB;
  for (const ConvexPart& part : table.parts())
    for (int e = 0; e < part.core.edgeCount(); ++e) {
      const std::array<Vec2, 2> edge = {at(X_WTable * part.core.vertex(part.core.edge(e).tail)),
                                        at(X_WTable * part.core.vertex(part.core.edge(e).head))};
      if ((edge[0] - edge[1]).norm() > 1e-6)
        canvas.line(edge, {{figure_color::kFaint}, 0.6 * size.line_px()});
    }
  for (const Vec3& p : figure.points_W) canvas.disc(at(p), 2.4 * size.line_px(), {figure_color::kOrange});
  canvas.disc(at(figure.foot_W), 3.2 * size.line_px(), {figure_color::kRed});
  canvas.text(at(figure.foot_W) + Vec2(size.em(), 0.0), "centre of mass",
              {size.em(), {figure_color::kRed}, renderer::Align::kLeft, true, 0.9});
  writeCaption(canvas,
               {"Figure 10. The support polygon, seen along gravity",
                {"The same table: outline and legs (grey), points of contact (orange), convex cover (green).",
                 "It is " + restText(figure)}},
               size);
  return canvas.image();
}

}  // namespace carom::demos
