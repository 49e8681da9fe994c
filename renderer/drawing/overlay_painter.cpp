#include "renderer/drawing/overlay_painter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace carom::renderer {
namespace {

constexpr double kNearOverDistance = 1e-3;  // Of eye to target: what is nearer to the eye is cut off.
constexpr double kBeyondImage_px = 8.0;     // Lines are followed so far beyond the image.
constexpr double kSample_px = 1.5;          // Between two looks at the depth along a line.
constexpr double kHiddenDash_px = 4.0;
constexpr double kHeadLength = 5.5;  // Of an arrow, in line widths.
constexpr double kHeadWidth = 3.8;   // Of an arrow, in line widths.
constexpr double kHeadShare = 0.45;  // Of an arrow: its head is no longer than this.

// The part of the segment p + t d, t in [0, 1], inside a rectangle (Liang and Barsky, ACM TOG 3, 1984).
struct Part {
  double begin = 0.0;
  double end = 1.0;
};
std::optional<Part> insidePart(const Vec2& p, const Vec2& d, const PixelRect& rect) {
  Part part;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double to_low = rect.low[axis] - p[axis], to_high = rect.high[axis] - p[axis];
    if (d[axis] == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return std::nullopt;
      continue;
    }
    part.begin = std::max(part.begin, std::min(to_low / d[axis], to_high / d[axis]));
    part.end = std::min(part.end, std::max(to_low / d[axis], to_high / d[axis]));
  }
  if (part.begin >= part.end) return std::nullopt;
  return part;
}

}  // namespace

OverlayPainter::OverlayPainter(Canvas& canvas, const Camera& camera, const DepthImage& depth)
    : canvas_(canvas),
      depth_(depth),
      eye_(camera.eye),
      axes_(cameraAxes(camera)),
      focal_px_(focalLengthPixels(camera, canvas.height())),
      near_m_(kNearOverDistance * (camera.target - camera.eye).norm()) {}

Vec3 OverlayPainter::inView(const Vec3& p_W) const {
  const Vec3 p_E = p_W - eye_;
  return {axes_.right.dot(p_E), axes_.up.dot(p_E), axes_.forward.dot(p_E)};
}

Vec2 OverlayPainter::onImage(const Vec3& p_V) const {
  const double scale = focal_px_ / p_V.z();
  return {0.5 * canvas_.width() + scale * p_V.x(), 0.5 * canvas_.height() - scale * p_V.y()};
}

std::optional<Vec2> OverlayPainter::pixel(const Vec3& p_W) const {
  const Vec3 p_V = inView(p_W);
  if (p_V.z() < near_m_) return std::nullopt;
  return onImage(p_V);
}

double OverlayPainter::metresPerPixel(const Vec3& p_W) const {
  return std::max(inView(p_W).z(), near_m_) / focal_px_;
}

// A mark on a surface may fall beside its pixel's middle, and beside a silhouette; so it has to be
// behind all pixels around.
bool OverlayPainter::isHidden(const Vec2& pixel, double depth_m) const {
  if (depth_.depth_m.empty()) return false;
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x >= depth_.width || y >= depth_.height) return false;
  const auto behind = [&](int i, int j) {
    const std::size_t index =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(depth_.width) + static_cast<std::size_t>(i);
    return depth_m - lift_m_ > static_cast<double>(depth_.depth_m[index]) * (1.0 + kDepthSlack);
  };
  if (!behind(x, y)) return false;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, depth_.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, depth_.width - 1); ++i)
      if (!behind(i, j)) return false;
  return true;
}

bool OverlayPainter::isHidden(const Vec3& p_W) const {
  const Vec3 p_V = inView(p_W);
  return p_V.z() >= near_m_ && isHidden(onImage(p_V), p_V.z());
}

void OverlayPainter::lineOnImage(const std::vector<Vec2>& run, bool hidden, const Stroke& stroke) {
  if (run.size() < 2) return;
  Stroke shown = stroke;
  if (hidden) {
    shown.ink.opacity *= kHiddenOpacity;
    shown.halo = 0.0;
    shown.dash_px = kHiddenDash_px;
  }
  canvas_.line(run, shown);
}

// Follows one segment and appends to the run of equally visible points, which is drawn where that changes or
// where the line leaves the image. One over the depth is linear along the image of a segment.
void OverlayPainter::segmentRuns(const Vec3& a_V, const Vec3& b_V, std::vector<Vec2>& run, bool& run_hidden,
                                 const Stroke& stroke) {
  const auto flush = [&] {
    lineOnImage(run, run_hidden, stroke);
    run.clear();
  };
  Vec3 a = a_V, b = b_V;
  if (a.z() < near_m_ && b.z() < near_m_) return flush();
  if (a.z() < near_m_) a = a + (near_m_ - a.z()) / (b.z() - a.z()) * (b - a);
  if (b.z() < near_m_) b = b + (near_m_ - b.z()) / (a.z() - b.z()) * (a - b);
  const Vec2 from = onImage(a), along = onImage(b) - from;
  const Vec2 border = Vec2::Constant(kBeyondImage_px);
  const std::optional<Part> part =
      insidePart(from, along, {-border, Vec2(canvas_.width(), canvas_.height()) + border});
  if (!part) return flush();
  if (part->begin > 0.0) flush();
  const double length = (part->end - part->begin) * along.norm();
  const int samples = std::max(1, static_cast<int>(std::ceil(length / kSample_px)));
  const auto at = [&](double share) { return part->begin + (part->end - part->begin) * share; };
  for (int i = 0; i < samples; ++i) {
    const double t = at((i + 0.5) / samples);
    const bool hidden = isHidden(from + t * along, 1.0 / ((1.0 - t) / a.z() + t / b.z()));
    const Vec2 begin = from + at(static_cast<double>(i) / samples) * along;
    if (!run.empty() && hidden != run_hidden) flush();
    if (run.empty()) run.push_back(begin);
    run_hidden = hidden;
    const Vec2 end = from + at((i + 1.0) / samples) * along;
    if (i > 0 && run.size() > 1)
      run.back() = end;  // the stretch before goes on
    else
      run.push_back(end);
  }
  if (part->end < 1.0) flush();
}

void OverlayPainter::line(std::span<const Vec3> points_W, const Stroke& stroke, bool closed) {
  std::vector<Vec2> run;
  bool hidden = false;
  const std::size_t segments = points_W.size() < 2 ? 0 : points_W.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < segments; ++i)
    segmentRuns(inView(points_W[i]), inView(points_W[(i + 1) % points_W.size()]), run, hidden, stroke);
  lineOnImage(run, hidden, stroke);
}

void OverlayPainter::line(const Vec3& a_W, const Vec3& b_W, const Stroke& stroke) {
  const std::array<Vec3, 2> points = {a_W, b_W};
  line(points, stroke);
}

void OverlayPainter::arrow(const Vec3& a_W, const Vec3& b_W, const Stroke& stroke) {
  const std::optional<Vec2> tail = pixel(a_W), tip = pixel(b_W);
  if (!tail || !tip) return line(a_W, b_W, stroke);
  const double length = (*tip - *tail).norm();
  const double head = std::min(kHeadLength * stroke.width_px, kHeadShare * length);
  if (!(length > 1e-9)) return;
  line(a_W, b_W + head / length * (a_W - b_W), stroke);
  const Vec2 along = (*tip - *tail) / length, across(-along.y(), along.x());
  const double half = 0.5 * kHeadWidth / kHeadLength * head;
  const Vec2 base = *tip - head * along;
  const std::array<Vec2, 3> corners = {*tip, base + half * across, base - half * across};
  Ink ink = stroke.ink;
  const bool hidden = isHidden(b_W);
  if (hidden) ink.opacity *= kHiddenOpacity;
  if (stroke.halo > 0.0 && !hidden) {
    const Stroke border{{{1.0f, 1.0f, 1.0f}, stroke.halo * ink.opacity}, 2.0};
    canvas_.line(corners, border, true);
  }
  canvas_.fill(corners, ink);
}

void OverlayPainter::dot(const Vec3& p_W, double radius_px, const Ink& ink) {
  const std::optional<Vec2> at = pixel(p_W);
  if (!at) return;
  const bool hidden = isHidden(p_W);
  const double share = hidden ? kHiddenOpacity : 1.0;
  if (!hidden) canvas_.disc(*at, radius_px + 1.2, {{1.0f, 1.0f, 1.0f}, ink.opacity});
  canvas_.disc(*at, radius_px, {ink.color, ink.opacity * share});
}

// Corners nearer than the near plane are cut away; each pixel compares the depth of the polygon's plane.
void OverlayPainter::area(std::span<const Vec3> corners_W, const Ink& ink) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < corners_W.size(); ++i) {
    const Vec3 p = inView(corners_W[i]), q = inView(corners_W[(i + 1) % corners_W.size()]);
    if (p.z() >= near_m_) corners.push_back(p);
    if ((p.z() >= near_m_) != (q.z() >= near_m_))
      corners.push_back(p + (near_m_ - p.z()) / (q.z() - p.z()) * (q - p));
  }
  if (corners.size() < 3) return;
  std::vector<Vec2> outline;
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    outline.push_back(onImage(corners[i]));
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  const double offset = normal.dot(corners[0]);
  canvas_.fill(outline, ink, [&](int x, int y) {
    const Vec2 p(x + 0.5, y + 0.5);
    const Vec3 ray((p.x() - 0.5 * canvas_.width()) / focal_px_, (0.5 * canvas_.height() - p.y()) / focal_px_,
                   1.0);
    const double slope = normal.dot(ray);
    return slope != 0.0 && isHidden(p, offset / slope) ? kHiddenOpacity : 1.0;
  });
}

// Right and left of the point, then above and below, then farther off.
std::optional<PixelRect> OverlayPainter::place(const Vec3& p_W, const Vec2& size_px, double gap_px) {
  constexpr double kFarthest = 3.5;  // Gaps, or sizes above and below.
  const std::optional<Vec2> at = pixel(p_W);
  const PixelRect image{Vec2::Zero(), Vec2(canvas_.width(), canvas_.height())};
  if (!at || (at->array() < 0.0).any() || (at->array() > image.high.array()).any()) return std::nullopt;
  for (double reach = 1.0; reach < kFarthest; reach += 1.0)
    for (const Vec2& side : {Vec2(1.0, -0.6), Vec2(-1.0, -0.6), Vec2(1.0, 0.6), Vec2(-1.0, 0.6),
                             Vec2(0.0, -1.3), Vec2(0.0, 1.3)}) {
      const double left = side.x() > 0.0   ? at->x() + reach * gap_px
                          : side.x() < 0.0 ? at->x() - reach * gap_px - size_px.x()
                                           : at->x() - 0.5 * size_px.x();
      const Vec2 corner(left, at->y() + (reach * side.y() - 0.5) * size_px.y());
      const PixelRect rect{corner, corner + size_px};
      const bool inside = (rect.low.array() >= 0.0).all() && (rect.high.array() <= image.high.array()).all();
      const bool free = std::none_of(taken_.begin(), taken_.end(),
                                     [&](const PixelRect& taken) { return taken.overlaps(rect); });
      if (!inside || !free) continue;
      taken_.push_back(rect);
      return rect;
    }
  return std::nullopt;
}

bool OverlayPainter::label(const Vec3& p_W, const std::string& words, const TextStyle& style) {
  const Vec2 size(canvas_.textWidth(words, style), 1.1 * style.size_px);
  const std::optional<PixelRect> rect = place(p_W, size, 0.5 * style.size_px);
  if (!rect) return false;
  TextStyle shown = style;
  shown.align = Align::kLeft;
  if (isHidden(p_W)) shown.ink.opacity *= 0.5 + 0.5 * kHiddenOpacity;
  canvas_.text({rect->low.x(), 0.5 * (rect->low.y() + rect->high.y())}, words, shown);
  return true;
}

}  // namespace carom::renderer
