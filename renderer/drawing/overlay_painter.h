#pragma once
// Draws marks of the world over a finished frame: lines, arrows, points, areas and labels in world
// coordinates, projected as the frame was, and depth-aware: what a body hides is drawn faint and dashed.
// Labels don't cover each other. Tested in tests/renderer/drawing/overlay_painter_test.cpp.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/drawing/canvas.h"
#include "renderer/image/image.h"
#include "renderer/view/projection.h"

namespace carom::renderer {

/// Of hidden marks, relative to visible ones.
inline constexpr double kHiddenOpacity = 0.38;

/// A rectangle of the image, pixels.
struct PixelRect {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  bool overlaps(const PixelRect& other) const {
    return low.x() < other.high.x() && other.low.x() < high.x() && low.y() < other.high.y() &&
           other.low.y() < high.y();
  }
};

class OverlayPainter {
 public:
  /// `depth` is that of the frame under the canvas, of the canvas's size; without pixels nothing is hidden.
  /// All must outlive this.
  OverlayPainter(Canvas& canvas, const Camera& camera, const DepthImage& depth);

  Canvas& canvas() { return canvas_; }
  const CameraAxes& axes() const { return axes_; }

  /// Where a point is drawn; nothing for one beside or behind the eye.
  std::optional<Vec2> pixel(const Vec3& p_W) const;
  /// Whether something of the frame is in front of the point by more than `kDepthSlack` of its distance, in
  /// its pixel and all around. Outside the image nothing is hidden.
  bool isHidden(const Vec3& p_W) const;
  /// The length at a point, metres, that the camera sees as one pixel.
  double metresPerPixel(const Vec3& p_W) const;

  void line(std::span<const Vec3> points_W, const Stroke& stroke, bool closed = false);
  void line(const Vec3& a_W, const Vec3& b_W, const Stroke& stroke);
  /// A line from `a_W` with its head's tip at `b_W`.
  void arrow(const Vec3& a_W, const Vec3& b_W, const Stroke& stroke);
  void dot(const Vec3& p_W, double radius_px, const Ink& ink);
  /// A convex plane polygon.
  void area(std::span<const Vec3> corners_W, const Ink& ink);
  /// Beside the point, where nothing else is written; false when there is no such place.
  bool label(const Vec3& p_W, const std::string& words, const TextStyle& style);
  /// A free rectangle of that size beside the point, inside the image, which is then taken; nothing when
  /// there is none or when the point is outside the image.
  std::optional<PixelRect> place(const Vec3& p_W, const Vec2& size_px, double gap_px);
  /// Keeps labels out of a part of the image.
  void reserve(const PixelRect& rect) { taken_.push_back(rect); }

  /// Marks drawn from now on are not hidden by what is in front of them by less: those inside a body (its
  /// centre, its path) take the body's radius, and are hidden by other bodies only.
  void setLift(double lift_m) { lift_m_ = lift_m; }

  static constexpr double kDepthSlack = 2e-3;

 private:
  /// In the camera's axes: right, up, forward.
  Vec3 inView(const Vec3& p_W) const;
  Vec2 onImage(const Vec3& p_V) const;
  bool isHidden(const Vec2& pixel, double depth_m) const;
  void lineOnImage(const std::vector<Vec2>& run, bool hidden, const Stroke& stroke);
  void segmentRuns(const Vec3& a_V, const Vec3& b_V, std::vector<Vec2>& run, bool& run_hidden,
                   const Stroke& stroke);

  Canvas& canvas_;
  const DepthImage& depth_;
  Vec3 eye_;
  CameraAxes axes_;
  double focal_px_;
  double near_m_;
  double lift_m_ = 0.0;
  std::vector<PixelRect> taken_;
};

}  // namespace carom::renderer
