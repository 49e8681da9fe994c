#include "demos/overlay/feature_overlays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "demos/format/formatted.h"
#include "demos/overlay/v_region_shape.h"

namespace carom::demos {
namespace {

using renderer::OverlayPainter;
using renderer::Stroke;

constexpr std::size_t kMostFeatures = 8;   // Pairs whose features are drawn.
constexpr std::size_t kMostDistances = 8;  // Pairs whose distance is written.
constexpr double kRegionReach = 1.2;       // Of the smaller body's radius.
constexpr double kWideFace = 4.0;  // Faces reaching farther, in those radii, are shown about the witness.
constexpr double kRegionOpacity = 0.16;

/// One body of a pair: its core, where it stands, its feature and witness point.
struct Side {
  const ConvexPart& part;
  const Pose& X_W;
  Feature feature;
  Vec3 p_W;
};
std::array<Side, 2> sidesOf(const NearPair& pair) {
  return {Side{*pair.part_a, pair.X_WA, pair.closest.features.a, pair.closest.p_A_W},
          Side{*pair.part_b, pair.X_WB, pair.closest.features.b, pair.closest.p_B_W}};
}

std::vector<Vec3> inWorld(const Pose& X_W, const std::vector<Vec3>& points) {
  std::vector<Vec3> moved;
  for (const Vec3& p : points) moved.push_back(X_W * p);
  return moved;
}

// A wide face's region about the witness: a column of the same height, its sides not those of the region.
void paintColumn(OverlayPainter& painter, const Side& side, double reach_m, const Stroke& stroke) {
  const Vec3 n = side.X_W.rotation * side.part.core.plane(side.feature.index).normal;
  const TangentBasis plane = tangentBasis(n);
  std::vector<Vec3> low, high;
  for (const Vec2& c : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
    low.push_back(side.p_W + reach_m * (c.x() * plane.t1 + c.y() * plane.t2));
    high.push_back(low.back() + reach_m * n);
  }
  painter.area(low, {stroke.ink.color, kRegionOpacity});
  Stroke cut = stroke;
  cut.dash_px = 5.0;
  painter.line(high, cut, true);
  painter.line(low, cut, true);
  for (std::size_t i = 0; i < low.size(); ++i) painter.arrow(low[i], high[i], stroke);
}

void paintRegion(OverlayPainter& painter, const Side& side, double radius_m, const Stroke& stroke) {
  const double reach_m = kRegionReach * radius_m;
  if (side.feature.kind == FeatureKind::kFace)
    for (const Vec3& corner : featureCorners(side.part.core, side.feature))
      if ((side.X_W * corner - side.p_W).norm() > kWideFace * radius_m)
        return paintColumn(painter, side, reach_m, stroke);
  const RegionShape shape = regionShape(side.part.core, side.feature, reach_m);
  for (const std::vector<Vec3>& polygon : shape.sides) {
    const std::vector<Vec3> corners = inWorld(side.X_W, polygon);
    painter.area(corners, {stroke.ink.color, kRegionOpacity});
    // The two straight borders of a side lead away from the feature.
    painter.line(corners.front(), corners.back(), stroke);
    painter.line(corners[corners.size() - 2], corners.back(), stroke);
    if (corners.size() == 4) painter.line(corners[1], corners[2], stroke);
  }
  for (const std::vector<Vec3>& rim : shape.rims) painter.line(inWorld(side.X_W, rim), stroke);
}

// A feature of a rounded part is drawn on its core's support plane, moved out to the surface. The corners of
// a wide face (a floor's) are drawn in towards the witness.
std::vector<Vec3> shownFeature(const Side& side, const Vec3& outward_W, double radius_m) {
  std::vector<Vec3> corners = inWorld(side.X_W, featureCorners(side.part.core, side.feature));
  for (Vec3& corner : corners) {
    corner += side.part.radius_m * outward_W;
    const double distance = (corner - side.p_W).norm();
    if (side.feature.kind == FeatureKind::kFace && distance > kWideFace * radius_m)
      corner = side.p_W + radius_m / distance * (corner - side.p_W);
  }
  return corners;
}

void paintFeature(OverlayPainter& painter, const std::vector<Vec3>& corners, const renderer::Color& color,
                  const Pen& pen) {
  const Stroke stroke{{color}, pen.thick_px(), 0.0, 0.6};
  if (corners.size() == 1) return painter.dot(corners[0], pen.dot_px() + pen.thin_px, {color});
  if (corners.size() > 2) painter.area(corners, {color, 0.28});
  painter.line(corners, stroke, corners.size() > 2);
}

// A feature that is closest to several bodies (a floor's face) is drawn once.
class DrawnFeatures {
 public:
  /// Whether it is drawn for the first time.
  bool add(const ConvexPart* part, int body, const Feature& feature) {
    const Drawn drawn{part, body, feature};
    if (std::find(drawn_.begin(), drawn_.end(), drawn) != drawn_.end()) return false;
    drawn_.push_back(drawn);
    return true;
  }

 private:
  struct Drawn {
    const ConvexPart* part;
    int body;
    Feature feature;
    friend bool operator==(const Drawn&, const Drawn&) = default;
  };
  std::vector<Drawn> drawn_;
};

}  // namespace

std::string lengthText(double length_m) {
  const double size = std::abs(length_m);
  return size < 0.1 ? formatted("%.2f mm", 1000.0 * length_m) : formatted("%.3f m", length_m);
}

void paintRegions(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  if (frame.pairs.empty()) return;
  const NearPair& pair = frame.pairs.front();
  const double radius = frame.pairRadius(pair.body_a, pair.body_b);
  const std::array<Side, 2> sides = sidesOf(pair);
  paintRegion(painter, sides[0], radius, {{overlay_color::kSky}, pen.thin_px});
  paintRegion(painter, sides[1], radius, {{overlay_color::kOrange}, pen.thin_px});
}

void paintClosest(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  const std::size_t count = std::min(kMostFeatures, frame.pairs.size());
  DrawnFeatures drawn;
  for (std::size_t i = 0; i < count; ++i) {
    const NearPair& pair = frame.pairs[i];
    const std::array<Side, 2> sides = sidesOf(pair);
    const double radius = frame.pairRadius(pair.body_a, pair.body_b);
    if (drawn.add(pair.part_a, pair.body_a, sides[0].feature))
      paintFeature(painter, shownFeature(sides[0], pair.closest.n_W, radius), overlay_color::kSky, pen);
    if (drawn.add(pair.part_b, pair.body_b, sides[1].feature))
      paintFeature(painter, shownFeature(sides[1], -pair.closest.n_W, radius), overlay_color::kOrange, pen);
    painter.line(pair.closest.p_A_W, pair.closest.p_B_W, {{overlay_color::kBlack}, pen.thin_px, 0.0, 0.6});
    painter.dot(pair.closest.p_A_W, pen.dot_px(), {overlay_color::kRed});
    painter.dot(pair.closest.p_B_W, pen.dot_px(), {overlay_color::kRed});
  }
}

void paintDistances(OverlayPainter& painter, const OverlayFrame& frame, const Pen& pen) {
  const std::size_t count = std::min(kMostDistances, frame.pairs.size());
  for (std::size_t i = 0; i < count; ++i) {
    const ClosestFeatures& closest = frame.pairs[i].closest;
    painter.line(closest.p_A_W, closest.p_B_W, {{overlay_color::kBlack}, pen.thin_px, 0.0, 0.6});
    painter.label(0.5 * (closest.p_A_W + closest.p_B_W), lengthText(closest.distance_m),
                  {pen.text_px, {overlay_color::kBlack}, renderer::Align::kLeft, true, 0.9});
  }
}

}  // namespace carom::demos
