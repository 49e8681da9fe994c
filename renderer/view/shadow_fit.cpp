#include "renderer/view/shadow_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace carom::renderer {
namespace {

constexpr double kReceiverReach =
    1.6;  // Shadows are drawn up to this multiple of the farthest caster's distance.
constexpr double kStepsPerDoubling = 4.0;
constexpr int kBorderTexels = 6;        // Kept free around the casters: the filter's reach.
constexpr double kGridsPerSide = 16.0;  // Steps of the place of the map, over its own size.

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
  void include(const Range& other) { include(other.low), include(other.high); }
  bool meets(const Range& other) const { return low <= other.high && other.low <= high; }
  void cutTo(const Range& other) { low = std::max(low, other.low), high = std::min(high, other.high); }
  double length() const { return high - low; }
};

struct LightAxes {
  Vec3 axis[3];  // Across, across, towards the light.
};

// One side of the map runs along the view, where the visible region is longest.
LightAxes lightAxes(const CameraAxes& camera, const Vec3& to_light) {
  const Vec3 z = to_light.normalized();
  Vec3 x = camera.forward - camera.forward.dot(z) * z;
  if (x.norm() < 1e-3) x = camera.right - camera.right.dot(z) * z;
  x.normalize();
  return {{x, z.cross(x), z}};
}

Range casterRange(const ShadowCaster& caster, const Vec3& axis) {
  const double middle = axis.dot(caster.X_EB.position);
  const double half = (caster.X_EB.rotation.conjugate() * axis).cwiseAbs().dot(caster.half);
  Range range;
  range.include(middle - half);
  range.include(middle + half);
  return range;
}

Range visibleRange(const ShadowRequest& request, const CameraAxes& camera, double reach_m, const Vec3& axis) {
  const double up = std::tan(0.5 * request.camera.fov_degrees * std::numbers::pi / 180.0);
  Range range;
  range.include(0.0);
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0}) {
      const Vec3 ray = camera.forward + sx * up * request.aspect * camera.right + sy * up * camera.up;
      range.include(reach_m * axis.dot(ray));
    }
  return range;
}

double reachOf(const std::vector<const ShadowCaster*>& casters) {
  double reach = 0.0;
  for (const ShadowCaster* c : casters)
    reach = std::max(reach, kReceiverReach * (c->X_EB.position.norm() + c->half.norm()));
  return reach;
}

// The casters whose shadows the camera may see. Those found first bound how far it has to look, which rules
// out more.
std::vector<const ShadowCaster*> relevant(const ShadowRequest& request, const CameraAxes& camera,
                                          const LightAxes& light, std::span<const ShadowCaster> casters) {
  std::vector<const ShadowCaster*> kept;
  for (const ShadowCaster& c : casters) kept.push_back(&c);
  for (int round = 0; round < 3; ++round) {
    const double reach = reachOf(kept);
    const Range x = visibleRange(request, camera, reach, light.axis[0]);
    const Range y = visibleRange(request, camera, reach, light.axis[1]);
    std::erase_if(kept, [&](const ShadowCaster* c) {
      return !casterRange(*c, light.axis[0]).meets(x) || !casterRange(*c, light.axis[1]).meets(y);
    });
  }
  return kept;
}

// The next of the sizes 2^(k/4): small changes of the bounds leave the map as it is.
double steppedUp(double length_m) {
  return std::exp2(std::ceil(std::log2(length_m) * kStepsPerDoubling) / kStepsPerDoubling);
}

// The next lower place of a grid that is fixed in the world; places are relative to the eye.
double snappedDown(double place_m, double grid_m, double eye_m) {
  return std::floor((place_m + eye_m) / grid_m) * grid_m - eye_m;
}

}  // namespace

ShadowView fitShadow(const ShadowRequest& request, std::span<const ShadowCaster> casters) {
  ShadowView view;
  const CameraAxes camera = cameraAxes(request.camera);
  const LightAxes light = lightAxes(camera, request.to_light);
  const std::vector<const ShadowCaster*> kept = relevant(request, camera, light, casters);
  if (kept.empty()) return view;  // No shadow can be seen.
  Range across[3];
  for (int i = 0; i < 3; ++i)
    for (const ShadowCaster* c : kept) across[i].include(casterRange(*c, light.axis[i]));
  const double reach = reachOf(kept);
  double side = 0.0;
  for (int i = 0; i < 2; ++i) {
    across[i].cutTo(visibleRange(request, camera, reach, light.axis[i]));
    side = std::max(side, across[i].length());
  }
  if (!(side > 0.0)) return view;
  const Range& depth = across[2];

  // Placed on a grid that is fixed in the world: no shadow crawls with a moving camera, and while few bodies
  // move most frames have the same map.
  const double border = kBorderTexels / static_cast<double>(request.texels);
  const double size = steppedUp(side / (1.0 - 2.0 * border - 1.0 / kGridsPerSide));
  view.texel_m = size / request.texels;
  const auto eyeAlong = [&](int i) { return light.axis[i].dot(request.camera.eye); };
  for (int i = 0; i < 2; ++i) {
    const double low = snappedDown(across[i].low - border * size, size / kGridsPerSide, eyeAlong(i));
    view.rows.block<1, 3>(i, 0) = light.axis[i].transpose() / size;
    view.rows(i, 3) = -low / size;
  }
  const double margin = 0.01 * depth.length() + view.texel_m;
  const double grid = steppedUp(depth.length() + 2.0 * margin) / kGridsPerSide;
  const double low = snappedDown(depth.low - margin, grid, eyeAlong(2));
  const double high = -snappedDown(-(depth.high + margin), grid, -eyeAlong(2));
  view.rows.block<1, 3>(2, 0) = -light.axis[2].transpose() / (high - low);
  view.rows(2, 3) = high / (high - low);
  return view;
}

std::array<Vec2, 4> coveredGround(const ShadowView& view, double ground_z_E) {
  // Solve rows * (x, y, z, 1) = (u, v) for x and y.
  const Eigen::Matrix2d uv_from_xy = view.rows.topLeftCorner<2, 2>();
  const Vec2 rest = view.rows.block<2, 1>(0, 2) * ground_z_E + view.rows.block<2, 1>(0, 3);
  std::array<Vec2, 4> corners = {Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(1.0, 1.0), Vec2(0.0, 1.0)};
  for (Vec2& corner : corners) corner = uv_from_xy.inverse() * Vec2(corner - rest);
  return corners;
}

}  // namespace carom::renderer
