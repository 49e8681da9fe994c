#include "demos/overlay/motion_overlays.h"

#include <algorithm>
#include <cmath>

namespace carom::demos {
namespace {

using renderer::OverlayPainter;
using renderer::Stroke;

constexpr double kShownSpeed_mps = 0.01;
constexpr double kShownSpin_radps = 0.02;
constexpr double kSpinTime_s = 0.12;     // An angular velocity's arrow, in radii a radian.
constexpr double kLongestArrow = 4.0;    // Of the body's radius.
constexpr std::size_t kTrailShades = 6;  // From faint, old, to full.

// The twelve edges join corners that differ in one bit.
void paintBox(OverlayPainter& painter, const Bounds& bounds, const Stroke& stroke) {
  const auto corner = [&](int bits) {
    return Vec3(bits & 1 ? bounds.high.x() : bounds.low.x(), bits & 2 ? bounds.high.y() : bounds.low.y(),
                bits & 4 ? bounds.high.z() : bounds.low.z());
  };
  for (int bits = 0; bits < 8; ++bits)
    for (int bit : {1, 2, 4})
      if ((bits & bit) == 0) painter.line(corner(bits), corner(bits | bit), stroke);
}

void paintVector(OverlayPainter& painter, const Vec3& from_W, const Vec3& along_W, double most_m,
                 const Stroke& stroke) {
  const double length = along_W.norm();
  painter.arrow(from_W, from_W + std::min(1.0, most_m / length) * along_W, stroke);
}

}  // namespace

void paintBounds(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  if (frame.step == nullptr) return;
  const std::vector<Bounds>& swept = frame.step->swept;
  for (std::size_t i = 0; i < swept.size(); ++i) {
    const int body = static_cast<int>(i);
    if (!frame.isStatic(body) && frame.focus.has(body))
      paintBox(painter, swept[i], {{overlay_color::kSky, 0.9}, pen.thin_px});
  }
}

void paintCandidates(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  if (frame.step == nullptr) return;
  for (const CandidateView& pair : frame.step->candidates) {
    if (!frame.focus.hasPair(pair.body_a, pair.body_b)) continue;
    const Bounds& a = frame.step->swept[static_cast<std::size_t>(pair.body_a)];
    const Bounds& b = frame.step->swept[static_cast<std::size_t>(pair.body_b)];
    const Vec3 meeting = 0.5 * (a.low.cwiseMax(b.low) + a.high.cwiseMin(b.high));
    const double radius = frame.pairRadius(pair.body_a, pair.body_b);
    painter.setLift(2.0 * radius);
    for (int body : {pair.body_a, pair.body_b})
      if (!frame.isStatic(body))
        painter.line(frame.state(body).X_WB.position, meeting,
                     {{overlay_color::kPurple}, pen.thin_px, 0.0, 0.4});
    painter.dot(meeting, pen.dot_px(), {overlay_color::kPurple});
    painter.setLift(0.0);
  }
}

void paintVelocities(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  for (int body = 0; body < static_cast<int>(frame.bodies.size()); ++body) {
    if (frame.isStatic(body) || !frame.focus.has(body)) continue;
    const BodyState& state = frame.state(body);
    const double radius = frame.drawnRadius(body);
    painter.setLift(2.0 * radius);
    if (state.angular_velocity.norm() > kShownSpin_radps)
      paintVector(painter, state.X_WB.position, kSpinTime_s * radius * state.angular_velocity,
                  kLongestArrow * radius, {{overlay_color::kPurple}, pen.thin_px, 0.0, 0.6});
    if (state.linear_velocity.norm() > kShownSpeed_mps)
      paintVector(painter, state.X_WB.position, kVelocityTime_s * state.linear_velocity,
                  kLongestArrow * radius, {{overlay_color::kGreen}, pen.thick_px(), 0.0, 0.6});
    painter.setLift(0.0);
  }
}

void paintTrails(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  for (int body = 0; body < static_cast<int>(frame.trails.size()); ++body) {
    const std::vector<Vec3>& trail = frame.trails[static_cast<std::size_t>(body)];
    if (frame.isStatic(body) || !frame.focus.has(body) || trail.size() < 2) continue;
    painter.setLift(2.0 * frame.drawnRadius(body));
    for (std::size_t shade = 0; shade < kTrailShades; ++shade) {
      const std::size_t begin = (trail.size() - 1) * shade / kTrailShades;
      const std::size_t end = (trail.size() - 1) * (shade + 1) / kTrailShades;
      if (begin == end) continue;
      const double opacity = (static_cast<double>(shade) + 1.0) / kTrailShades;
      painter.line(std::span(trail).subspan(begin, end - begin + 1),
                   {{overlay_color::kBlue, opacity}, pen.thick_px(), 0.0, 0.4});
    }
    painter.setLift(0.0);
  }
}

void paintLabels(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  std::vector<int> order;
  for (int body = 0; body < static_cast<int>(frame.bodies.size()); ++body)
    if (frame.focus.has(body) && !frame.scene.looks[static_cast<std::size_t>(body)].checker)
      order.push_back(body);
  const auto ahead = [&](int body) { return painter.axes().forward.dot(frame.state(body).X_WB.position); };
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return ahead(x) < ahead(y); });
  for (int body : order) {
    painter.setLift(frame.drawnRadius(body));
    painter.label(frame.state(body).X_WB.position, frame.scene.names[static_cast<std::size_t>(body)],
                  {pen.text_px, {overlay_color::kBlack}, renderer::Align::kLeft, false, 0.9});
    painter.setLift(0.0);
  }
}

}  // namespace carom::demos
