#include "demos/figure/figure_distance.h"

#include <algorithm>
#include <array>

#include "demos/format/formatted.h"
#include "demos/overlay/overlay_frame.h"
#include "engine/contact/time_of_impact.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

constexpr double kSample_s = 1.0 / 960.0;  // Of the curves, and the step of the run.
constexpr int kMostRoots = 24;
const Vec3 kGravity(0.0, 0.0, -9.81);

ClosestFeatures closestOf(const DistanceFigure& figure, const Pose& X_WRod) {
  FeaturePair cold;
  return closestFeatures(figure.plate.parts()[0], figure.X_WPlate, figure.rod.parts()[0], X_WRod, cold);
}

// The same path run backwards from `end_s`: its time 0 is there.
Trajectory reversed(const Trajectory& path, double end_s) {
  return {0.0, path.at(end_s), -path.velocityAt(end_s), path.acceleration, -path.spin};
}

// The first time at which `path`, from `begin_s` on, comes down to the collision window; nothing until
// `end_s`.
std::optional<double> firstImpact(const DistanceFigure& figure, const Trajectory& path, double begin_s,
                                  double end_s) {
  const ConvexPart& plate = figure.plate.parts()[0];
  const ConvexPart& rod = figure.rod.parts()[0];
  const Trajectory still{0.0, figure.X_WPlate, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const Pose plate_end = figure.X_WPlate, rod_end = path.at(end_s);
  const ImpactSearch search{collisionWindow(plate, rod), 0.0, begin_s, end_s};
  FeaturePair tracked;
  const TimeOfImpact found = timeOfImpact({&plate, &still, plate.core.radiusAbout(Vec3::Zero()), &plate_end},
                                          {&rod, &path, rod.core.radiusAbout(Vec3::Zero()), &rod_end}, search,
                                          closestOf(figure, path.at(begin_s)), tracked);
  if (found.outcome == TimeOfImpact::Outcome::kClear) return std::nullopt;
  return found.time_s;
}

// Entries are searched forwards from where the bodies are apart, exits backwards from where they are again.
void findRoots(DistanceFigure& figure) {
  double begin = 0.0;
  for (int i = 0; i < kMostRoots; ++i) {
    const std::optional<double> entry = firstImpact(figure, figure.path, begin, figure.duration_s);
    if (!entry) return;
    figure.roots_s.push_back(*entry);
    const double clear_m = 4.0 * collisionWindow(figure.plate.parts()[0], figure.rod.parts()[0]).ceiling;
    const auto apart = std::find_if(figure.free_curve.begin(), figure.free_curve.end(), [&](const Vec2& p) {
      return p.x() > *entry + kSample_s && p.y() > clear_m;
    });
    if (apart == figure.free_curve.end()) return;
    const Trajectory back = reversed(figure.path, apart->x());
    const std::optional<double> exit = firstImpact(figure, back, 0.0, apart->x() - *entry);
    REQUIRE(exit.has_value(), apart->x());
    figure.roots_s.push_back(apart->x() - *exit);
    begin = apart->x();
  }
}

void runWorld(DistanceFigure& figure) {
  World world({kSample_s, kGravity, true});
  BodyDescription plate{world.addSolid(figure.plate), figure.X_WPlate, Vec3::Zero(), Vec3::Zero(), {}, true};
  BodyDescription rod{
      world.addSolid(figure.rod), figure.path.X_WB, figure.path.velocity, figure.path.spin, {}, false};
  rod.linear_velocity = figure.path.velocity;
  rod.angular_velocity = figure.path.spin;
  plate.linear_velocity = plate.angular_velocity = Vec3::Zero();
  rod.material.restitution = 0.4;
  world.addBody(plate);
  world.addBody(rod);
  REQUIRE(world.start().empty());
  StepView view;
  world.watch(&view);
  const auto note = [&] {
    figure.run_curve.emplace_back(world.time(), closestOf(figure, world.states()[1].X_WB).distance_m);
  };
  note();
  while (world.time() < figure.duration_s) {
    world.step();
    note();
  }
  REQUIRE(!view.collisions.empty());
  figure.collision_s = view.collisions.front().time_s;
}

}  // namespace

double DistanceFigure::freeDistance(double t_s) const {
  return closestOf(*this, path.at(t_s)).distance_m;
}

Plot DistanceFigure::plot(const PageSize& size) const {
  const double em = size.em();
  double low = 0.0, high = 0.0;
  for (const Vec2& p : free_curve) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  for (const Vec2& p : run_curve) high = std::max(high, p.y());
  return {{Vec2(5.0 * em, 3.0 * em), Vec2(size.width - 7.0 * em, captionTop(size) - 3.2 * em)},
          {0.0, duration_s},
          {1.1 * low, 1.1 * high}};
}

DistanceFigure distanceFigure() {
  DistanceFigure figure;
  figure.X_WPlate.position = Vec3(0.0, 0.0, -1.0);
  figure.path.X_WB.position = Vec3(-0.6, 0.0, 0.82);
  figure.path.X_WB.rotation = rotationBy(Vec3(0.0, 0.5, 0.0));
  figure.path.velocity = Vec3(1.8, 0.0, 1.75);
  figure.path.acceleration = kGravity;
  figure.path.spin = Vec3(0.0, 24.0, 0.0);
  for (double t = 0.0; t < figure.duration_s + 0.5 * kSample_s; t += kSample_s)
    figure.free_curve.emplace_back(t, figure.freeDistance(t));
  findRoots(figure);
  runWorld(figure);
  return figure;
}

renderer::Image drawDistanceFigure(const DistanceFigure& figure, const PageSize& size) {
  renderer::Canvas canvas(size.width, size.height, figure_color::kPaper);
  const Plot plot = figure.plot(size);
  const double em = size.em();
  plot.drawAxes(canvas, {"t in s", "d(t) in m", 0.1, 0.2, 1, 1}, size);
  plot.drawLevel(canvas, 0.0, "d = 0", {{figure_color::kInk}, 0.8 * size.line_px()}, size);
  plot.drawCurve(canvas, figure.free_curve,
                 {{figure_color::kOrange}, 1.2 * size.line_px(), 3.0 * size.line_px()});
  plot.drawCurve(canvas, figure.run_curve, {{figure_color::kBlue}, 1.8 * size.line_px()});
  for (std::size_t i = 0; i < figure.roots_s.size(); ++i) {
    const Vec2 at = plot.pixel(figure.roots_s[i], 0.0);
    canvas.disc(at, 2.6 * size.line_px(), {figure_color::kRed});
    // Entries below on the left, exits above on the left: there the curve is not.
    canvas.text(at + Vec2(-0.5 * em, i % 2 == 0 ? 0.9 * em : -0.9 * em),
                std::string("t").append(std::to_string(i + 1)),
                {em, {figure_color::kRed}, renderer::Align::kRight, true, 0.9});
  }
  const Vec2 legend = plot.rect().low + Vec2(2.0 * em, 0.2 * em);
  const std::array<Vec2, 2> solid = {legend, legend + Vec2(2.5 * em, 0.0)};
  const std::array<Vec2, 2> dashed = {legend + Vec2(0.0, 1.5 * em), legend + Vec2(2.5 * em, 1.5 * em)};
  canvas.line(solid, {{figure_color::kBlue}, 1.8 * size.line_px()});
  canvas.line(dashed, {{figure_color::kOrange}, 1.2 * size.line_px(), 3.0 * size.line_px()});
  canvas.text(solid[1] + Vec2(0.7 * em, 0.0), "the run: the first root is found and answered",
              {0.9 * em, {figure_color::kInk}});
  canvas.text(dashed[1] + Vec2(0.7 * em, 0.0), "the same path with nothing answered",
              {0.9 * em, {figure_color::kInk}});
  writeCaption(canvas,
               {"Figure 6. The distance d(t) of two bodies",
                {"A rod thrown turning over a plate. d(t) dips without reaching zero, then passes zero " +
                     std::to_string(figure.roots_s.size()) + " times;",
                 "only the first root is a collision. The search for the time of impact finds it at " +
                     formatted("t1 = %.5f s, ", figure.roots_s.front()) +
                     formatted("the run collides at %.5f s.", figure.collision_s),
                 "Below zero d is the exact depth of penetration. The run's d(t) never gets there."}},
               size);
  return canvas.image();
}

}  // namespace carom::demos
