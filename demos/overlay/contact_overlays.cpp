#include "demos/overlay/contact_overlays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "demos/format/formatted.h"
#include "engine/contact/contact_polygon.h"
#include "engine/modes/support_polygon.h"

namespace carom::demos {
namespace {

using renderer::Align;
using renderer::OverlayPainter;
using renderer::Stroke;

constexpr std::size_t kMostNamedPairs = 4;
constexpr std::size_t kMostNamedImpulses = 6;
constexpr std::size_t kMostGauges = 6;
constexpr double kUpwards = 1e-3;  // Cosine by which a contact's normal leans against gravity to hold up.

std::string featureText(const Feature& feature) {
  constexpr std::array<const char*, 3> kLetters = {"V", "E", "F"};
  return std::string(kLetters[static_cast<std::size_t>(feature.kind)]).append(std::to_string(feature.index));
}

/// A zone of the gauge between two gaps.
struct GaugeZone {
  double low_m;
  double high_m;
  renderer::Color color;
};

void paintGauge(OverlayPainter& painter, const NearPair& pair, const Pen& pen) {
  const double text = 0.85 * pen.text_px, bar = 0.8 * text, tall = 6.0 * text, wide = 7.2 * text;
  const Vec3 contact = 0.5 * (pair.closest.p_A_W + pair.closest.p_B_W);
  const std::optional<renderer::PixelRect> rect =
      painter.place(contact, Vec2(wide, tall + 2.6 * text), 2.0 * text);
  const std::optional<Vec2> at = painter.pixel(contact);
  if (!rect || !at) return;
  renderer::Canvas& canvas = painter.canvas();
  const auto box = [&](const Vec2& low, const Vec2& high, const renderer::Ink& ink) {
    const std::array<Vec2, 4> corners = {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())};
    canvas.fill(corners, ink);
  };
  const Vec2 nearest = at->cwiseMax(rect->low).cwiseMin(rect->high);
  const std::array<Vec2, 2> leader = {*at, nearest};
  canvas.line(leader, {{overlay_color::kBlack, 0.7}, pen.thin_px, 0.0, 0.5});
  box(rect->low, rect->high, {overlay_color::kWhite, 0.82});
  const Vec2 low(rect->low.x() + 3.4 * text, rect->high.y() - 0.7 * text);
  const auto level = [&](double gap_m) { return low.y() - tall * gaugeHeight(gap_m, pair.window); };
  const CollisionWindow& w = pair.window;
  const double top = kGaugeOverCeiling * w.ceiling;
  for (const GaugeZone& zone :
       {GaugeZone{0.0, w.floor, overlay_color::kRed}, GaugeZone{w.floor, w.ceiling, overlay_color::kGreen},
        GaugeZone{w.ceiling, top, overlay_color::kSky}})
    box({low.x(), level(zone.high_m)}, {low.x() + bar, level(zone.low_m)}, {zone.color, 0.75});
  const auto tick = [&](double gap_m, const char* name) {
    canvas.text({low.x() - 0.4 * text, level(gap_m)}, name, {text, {overlay_color::kBlack}, Align::kRight});
  };
  tick(w.floor, "ε₁");
  tick(w.rest, "rest");
  tick(w.ceiling, "ε₂");
  const double needle = level(pair.closest.distance_m);
  const std::array<Vec2, 3> mark = {Vec2(low.x() + bar, needle),
                                    Vec2(low.x() + bar + 0.6 * text, needle - 0.4 * text),
                                    Vec2(low.x() + bar + 0.6 * text, needle + 0.4 * text)};
  canvas.fill(mark, {overlay_color::kBlack});
  canvas.text({rect->low.x() + 0.5 * wide, rect->low.y() + 0.9 * text}, lengthText(pair.closest.distance_m),
              {text, {overlay_color::kBlack}, Align::kMiddle, true});
}

}  // namespace

void paintNormals(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  for (const NearPair& pair : frame.pairs) {
    if (!touches(pair)) continue;
    const double length = normalLength(frame, pair);
    for (const ManifoldPoint& point : manifoldOf(pair))
      painter.arrow(point.p_W, point.p_W + length * point.n_W,
                    {{overlay_color::kBlue}, pen.thick_px(), 0.0, 0.6});
  }
}

void paintImpulses(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  std::size_t named = 0;
  for (const ShownImpulse& shown : shownImpulses(frame)) {
    const renderer::Color& color = shown.is_collision ? overlay_color::kRed : overlay_color::kOrange;
    const double width_px = (shown.is_collision ? 1.3 : 1.0) * pen.thick_px();
    painter.setLift(2.0 * frame.drawnRadius(shown.body));  // it stands inside the body that it pushes
    painter.arrow(shown.p_W, shown.p_W + shown.length_m * shown.impulse_W.normalized(),
                  {{color}, width_px, 0.0, 0.6});
    painter.setLift(0.0);
    if (!shown.is_collision || named++ >= kMostNamedImpulses) continue;
    painter.label(shown.p_W, formatted("%.3g N s", shown.impulse_W.norm()),
                  {pen.text_px, {overlay_color::kRed}, Align::kLeft, true, 0.9});
  }
}

void paintManifolds(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  std::size_t named = 0;
  for (const NearPair& pair : frame.pairs) {
    if (pair.closest.distance_m > pair.window.manifold) continue;
    const ContactPolygon polygon =
        contactPolygon(pair.closest, *pair.part_a, pair.X_WA, *pair.part_b, pair.X_WB, pair.window);
    std::vector<Vec3> corners;
    for (const PolygonCorner& corner : polygon.corners) corners.push_back(corner.p_W);
    if (corners.size() > 2) painter.area(corners, {overlay_color::kOrange, 0.45});
    if (corners.size() > 1)
      painter.line(corners, {{overlay_color::kOrange}, pen.thick_px(), 0.0, 0.6}, corners.size() > 2);
    const bool names = named++ < kMostNamedPairs;
    for (const ManifoldPoint& point : manifoldOf(pair)) {
      painter.dot(point.p_W, pen.dot_px(), {overlay_color::kPurple});
      if (names)
        painter.label(point.p_W, featureText(point.features.a) + "·" + featureText(point.features.b),
                      {0.85 * pen.text_px, {overlay_color::kPurple}, Align::kLeft, true, 0.9});
    }
  }
}

double gaugeHeight(double gap_m, const CollisionWindow& window) {
  return std::clamp(gap_m / (kGaugeOverCeiling * window.ceiling), 0.0, 1.0);
}

void paintWindows(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  std::size_t gauges = 0;
  for (const NearPair& pair : frame.pairs) {
    if (gauges > 0 && (gauges >= kMostGauges || !touches(pair))) break;  // the nearest always has one
    paintGauge(painter, pair, pen);
    ++gauges;
  }
}

std::optional<ShownSupport> shownSupport(const OverlayFrame& frame, int body, const Vec3& gravity) {
  if (gravity.isZero(0.0)) return std::nullopt;
  const Vec3 down = gravity.normalized();
  std::vector<Vec3> held;
  for (const NearPair& pair : frame.pairs) {
    if ((pair.body_a != body && pair.body_b != body) || !touches(pair)) continue;
    const double sign = pair.body_b == body ? 1.0 : -1.0;  // of the normal towards the body
    for (const ManifoldPoint& point : manifoldOf(pair))
      if (sign * point.n_W.dot(down) < -kUpwards) held.push_back(point.p_W);
  }
  if (held.empty()) return std::nullopt;
  double level = 0.0;
  for (const Vec3& p : held) level += p.dot(down) / static_cast<double>(held.size());
  const TangentBasis plane = tangentBasis(down);
  const auto project = [&](const Vec3& p) { return Vec2(plane.t1.dot(p), plane.t2.dot(p)); };
  const auto place = [&](const Vec2& p) { return Vec3(p.x() * plane.t1 + p.y() * plane.t2 + level * down); };
  std::vector<Vec2> points;
  for (const Vec3& p : held) points.push_back(project(p));
  const std::vector<Vec2> cover = convexCover(points);
  const Vec2 foot = project(frame.state(body).X_WB.position);
  ShownSupport support{{}, place(foot), distanceOutside(cover, foot) == 0.0};
  for (const Vec2& p : cover) support.corners_W.push_back(place(p));
  return support;
}

void paintSupports(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  for (int body = 0; body < static_cast<int>(frame.bodies.size()); ++body) {
    if (frame.isStatic(body) || !frame.focus.has(body)) continue;
    const std::optional<ShownSupport> support =
        shownSupport(frame, body, frame.scene.world.settings().gravity);
    if (!support) continue;
    const renderer::Color color = support->holds ? overlay_color::kGreen : overlay_color::kRed;
    painter.setLift(2.0 * frame.drawnRadius(body));  // the body stands on it
    if (support->corners_W.size() > 2) painter.area(support->corners_W, {color, 0.35});
    if (support->corners_W.size() > 1)
      painter.line(support->corners_W, {{color}, pen.thick_px(), 0.0, 0.5}, support->corners_W.size() > 2);
    const Vec3& center = frame.state(body).X_WB.position;
    painter.line(center, support->foot_W, {{overlay_color::kBlack}, pen.thin_px, 4.0, 0.4});
    painter.dot(center, pen.dot_px(), {overlay_color::kBlack});
    painter.dot(support->foot_W, pen.dot_px() + 0.5 * pen.thin_px, {color});
    painter.setLift(0.0);
  }
}

}  // namespace carom::demos
