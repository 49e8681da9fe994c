#include "renderer/frame/frame_damage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "renderer/image/sequence_difference.h"

namespace carom::renderer {
namespace {

// Pixels around the exact bounds of a shape that rounding in its projection and clipping can reach.
constexpr double kRasterReach_px = 2.0;
// Of a point's distance from the eye: nearer to the eye's own plane, bounds on the image have no precision.
constexpr double kLeastDepth = 1e-3;
// Texels around a caster within which a look-up may meet it: the tent of the filter reaches two and a half,
// the lift above a grazed surface 2.2, rasterisation one.
constexpr double kLookUpReach_texels = 7.0;

using Rows = Eigen::Matrix<double, 3, 4>;

Rows rowsOf(const float (&from)[3][4]) {
  Rows rows;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k) rows(i, k) = static_cast<double>(from[i][k]);
  return rows;
}

Vec3 vectorOf(const float (&from)[3]) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

// What an interval of the map's coordinates, [0, 1] for all of its `texels`, covers of them.
int texelBelow(double coordinate, int texels) {
  return static_cast<int>(std::floor(std::clamp(coordinate, -1.0, 2.0) * texels));
}

// A box in the map's coordinates: across, across, and away from the light.
struct LightBox {
  Vec3 low, high;

  LightBox grown(const Vec3& by) const { return {low - by, high + by}; }
  LightBox cutTo(const LightBox& other) const { return {low.cwiseMax(other.low), high.cwiseMin(other.high)}; }
  bool isEmpty() const { return (low.array() > high.array()).any(); }  // Not with what is no number.
};

LightBox lightBox(const Rows& map_from_E, const DrawnBody& body) {
  const Rows E_from_B = rowsOf(body.record.rows);
  const Mat3 turned = map_from_E.leftCols<3>() * E_from_B.leftCols<3>();
  const Vec3 center_E = E_from_B.leftCols<3>() * vectorOf(body.mesh.center) + E_from_B.col(3);
  const Vec3 center = map_from_E.leftCols<3>() * center_E + map_from_E.col(3);
  const Vec3 half = turned.cwiseAbs() * vectorOf(body.mesh.half);
  return {center - half, center + half};
}

std::array<Vec3, 8> cornersOf(const Vec3& low, const Vec3& high) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {(i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                  (i & 4) != 0 ? high.z() : low.z()};
  return corners;
}

// Adds what does not appear in both, in the same order.
template <typename Drawn>
void addChanged(const std::vector<Drawn>& before, const std::vector<Drawn>& now, const ScreenBounds& bounds,
                Damage& damage) {
  const SequenceDifference changed = sequenceDifference(before, now, Order::kMatters);
  for (const std::size_t i : changed.gone) damage.add(bounds.of(before[i]));
  for (const std::size_t i : changed.come) damage.add(bounds.of(now[i]));
}

// Where what a caster does to the shadow map can be seen: on the bodies and on the ground behind it, seen
// from the light. The same map belongs to both frames.
class ShadowFall {
 public:
  ShadowFall(const FrameInputs& inputs, const ScreenBounds& bounds, int texels)
      : map_from_E_(rowsOf(inputs.block.shadow_rows)), bounds_(bounds) {
    E_from_map_ = map_from_E_.leftCols<3>().inverse();
    // A texel is as wide as it is high; along the light it is that share of the map's depth.
    const double texel_m = 1.0 / (texels * map_from_E_.row(0).head<3>().norm());
    for (int i = 0; i < 3; ++i)
      reach_[i] = kLookUpReach_texels * texel_m * map_from_E_.row(i).head<3>().norm();
    for (const DrawnBody& body : inputs.visible)
      if (body.look.shader != BodyShader::kSunlit)
        receivers_.push_back({lightBox(map_from_E_, body), bounds.of(body)});
    if (!inputs.ground_shadows.empty()) ground_z_E_ = static_cast<double>(inputs.block.ground[0]);
  }

  void add(const DrawnBody& caster, Damage& damage) const {
    LightBox shaded = lightBox(map_from_E_, caster).grown(reach_);
    shaded.high.z() = std::numeric_limits<double>::infinity();
    for (const Receiver& receiver : receivers_) {
      const LightBox hit = receiver.box.cutTo(shaded);
      if (damage.isWhole()) return;
      if (hit.isEmpty()) continue;
      std::array<Vec3, 8> corners = cornersOf(hit.low, hit.high);
      for (Vec3& p : corners) p = E_from_map_ * (p - map_from_E_.col(3));
      damage.add(common(bounds_.of(corners), receiver.seen));
    }
    if (ground_z_E_) addGround(shaded, damage);
  }

 private:
  struct Receiver {
    LightBox box;
    GridBlock seen;
  };

  // The light goes through the ground in a parallelogram.
  void addGround(const LightBox& shaded, Damage& damage) const {
    const Eigen::Matrix2d xy_from_uv = map_from_E_.topLeftCorner<2, 2>().inverse();
    const Vec2 rest = map_from_E_.block<2, 1>(0, 2) * *ground_z_E_ + map_from_E_.block<2, 1>(0, 3);
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 uv((i & 1) != 0 ? shaded.high.x() : shaded.low.x(),
                    (i & 2) != 0 ? shaded.high.y() : shaded.low.y());
      const Vec2 xy = xy_from_uv * (uv - rest);
      corners[i] = {xy.x(), xy.y(), *ground_z_E_};
    }
    damage.add(bounds_.of(corners));
  }

  Rows map_from_E_;
  Mat3 E_from_map_;
  Vec3 reach_;
  const ScreenBounds& bounds_;
  std::vector<Receiver> receivers_;
  std::optional<double> ground_z_E_;
};

}  // namespace

ScreenBounds::ScreenBounds(const FrameBlock& block, int width, int height)
    : image_{0, width, 0, height}, ground_z_E_(static_cast<double>(block.ground[0])) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) clip_from_E_(r, c) = static_cast<double>(block.clip_from_E[4 * c + r]);
}

GridBlock ScreenBounds::of(std::span<const Vec3> points_E) const {
  constexpr double kFar = 1e6;  // Pixels: far outside of any image.
  Vec2 low = Vec2::Constant(kFar), high = Vec2::Constant(-kFar);
  for (const Vec3& p : points_E) {
    const Eigen::Vector4d clip = clip_from_E_ * p.homogeneous();
    if (!(clip.w() > kLeastDepth * p.norm())) return image_;
    const Vec2 pixel(0.5 * image_.x_end * (1.0 + clip.x() / clip.w()),
                     0.5 * image_.y_end * (1.0 + clip.y() / clip.w()));
    if (!pixel.allFinite()) return image_;
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const auto whole = [kFar](double px) { return static_cast<int>(std::clamp(px, -kFar, kFar)); };
  return common({whole(std::floor(low.x() - kRasterReach_px)), whole(std::ceil(high.x() + kRasterReach_px)),
                 whole(std::floor(low.y() - kRasterReach_px)), whole(std::ceil(high.y() + kRasterReach_px))},
                image_);
}

GridBlock ScreenBounds::of(const DrawnBody& body) const {
  const Rows E_from_B = rowsOf(body.record.rows);
  const Vec3 center = vectorOf(body.mesh.center), half = vectorOf(body.mesh.half);
  std::array<Vec3, 8> corners = cornersOf(center - half, center + half);
  for (Vec3& p : corners) p = E_from_B * p.homogeneous();
  return of(corners);
}

GridBlock ScreenBounds::of(const GroundTriangle& triangle) const {
  std::array<Vec3, 3> points;
  for (std::size_t i = 0; i < 3; ++i)
    points[i] = {static_cast<double>(triangle[i][0]), static_cast<double>(triangle[i][1]), ground_z_E_};
  return of(points);
}

GridBlock ScreenBounds::of(const OcclusionTriangle& triangle) const {
  std::array<Vec3, 3> points;
  for (std::size_t i = 0; i < 3; ++i) points[i] = vectorOf(triangle[i].p_E);
  return of(points);
}

GridBlock shadowMapBounds(const FrameBlock& block, const DrawnBody& caster, int texels) {
  constexpr int kRasterReach_texels = 2;
  const GridBlock map{0, texels, 0, texels};
  const LightBox box = lightBox(rowsOf(block.shadow_rows), caster);
  if (!box.low.allFinite() || !box.high.allFinite()) return map;
  const GridBlock covered{texelBelow(box.low.x(), texels) - kRasterReach_texels,
                          texelBelow(box.high.x(), texels) + 1 + kRasterReach_texels,
                          texelBelow(box.low.y(), texels) - kRasterReach_texels,
                          texelBelow(box.high.y(), texels) + 1 + kRasterReach_texels};
  return common(covered, map);
}

FrameDamage wholeDamage(const FrameSizes& sizes) {
  FrameDamage damage{{sizes.width, sizes.height}, {sizes.shadow_texels, sizes.shadow_texels}};
  damage.image.addAll();
  damage.shadow_map.addAll();
  return damage;
}

FrameDamage frameDamage(const FrameInputs& before, const FrameInputs& now, const FrameSizes& sizes) {
  const bool same_view = before.ground_seen == now.ground_seen &&
                         before.ground_pattern == now.ground_pattern &&
                         std::memcmp(&before.block, &now.block, sizeof(FrameBlock)) == 0;
  if (!same_view) return wholeDamage(sizes);
  FrameDamage damage{{sizes.width, sizes.height}, {sizes.shadow_texels, sizes.shadow_texels}};
  const ScreenBounds bounds(now.block, sizes.width, sizes.height);
  addChanged(before.visible, now.visible, bounds, damage.image);
  addChanged(before.ground_shadows, now.ground_shadows, bounds, damage.image);
  addChanged(before.occlusion, now.occlusion, bounds, damage.image);

  const SequenceDifference casters = sequenceDifference(before.casting, now.casting, Order::kIsFree);
  if (casters.isEmpty()) return damage;
  const ShadowFall fall(now, bounds, sizes.shadow_texels);
  const auto addCaster = [&](const DrawnBody& caster) {
    damage.shadow_map.add(shadowMapBounds(now.block, caster, sizes.shadow_texels));
    fall.add(caster, damage.image);
  };
  for (const std::size_t i : casters.gone) addCaster(before.casting[i]);
  for (const std::size_t i : casters.come) addCaster(now.casting[i]);
  return damage;
}

}  // namespace carom::renderer
