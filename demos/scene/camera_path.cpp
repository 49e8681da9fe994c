#include "demos/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "demos/format/nearest_name.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

using std::numbers::pi;
constexpr double kMargin = 1.0 / 12.0;  // Of half the picture, on each side.
constexpr double kRadiiAway = 6.0;      // Of a followed body.

double radians(double degrees) {
  return degrees * pi / 180.0;
}

std::vector<Vec3> cornersOf(const Solid& solid, const Pose& X_WB) {
  const renderer::Extent extent = renderer::solidExtent(solid);
  std::vector<Vec3> corners;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        corners.push_back(X_WB * Vec3(extent.center + extent.half.cwiseProduct(Vec3(x, y, z))));
  return corners;
}

double highest(const std::vector<Vec3>& points) {
  double z = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) z = std::max(z, p.z());
  return z;
}

// How far apart and how low two opposite sides of the picture can be: the eye's coordinate across, and the
// farthest it may be along the view.
struct Slab {
  double across = 0.0;
  double most_along = 0.0;
};
Slab fitBetweenSides(std::span<const Vec3> points, const Vec3& across, const Vec3& along, double slope) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double low = -kInfinity, high = kInfinity;
  for (const Vec3& p : points) {
    low = std::max(low, p.dot(across) - slope * p.dot(along));
    high = std::min(high, p.dot(across) + slope * p.dot(along));
  }
  return {0.5 * (low + high), (high - low) / (2.0 * slope)};
}

std::size_t bodyNamed(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError("camera: no body \"" + name + "\" to follow" + acceptedNames(name, names));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

renderer::Camera fittedCamera(std::span<const Vec3> points, const FitRequest& request) {
  renderer::Camera camera{request.direction, Vec3::Zero(), request.fov_degrees};
  const renderer::CameraAxes axes = renderer::cameraAxes(camera);
  const SineCosine half = sineCosine(radians(0.5 * request.fov_degrees));
  const double up_slope = (1.0 - kMargin) * half.sine / half.cosine;
  const Slab sides = fitBetweenSides(points, axes.right, axes.forward, up_slope * request.aspect);
  const Slab top_and_bottom = fitBetweenSides(points, axes.up, axes.forward, up_slope);
  const double along = std::min(sides.most_along, top_and_bottom.most_along);
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Vec3& p : points) {
    nearest = std::min(nearest, p.dot(axes.forward));
    farthest = std::max(farthest, p.dot(axes.forward));
  }
  camera.eye = sides.across * axes.right + top_and_bottom.across * axes.up + along * axes.forward;
  camera.target = camera.eye + (0.5 * (nearest + farthest) - along) * axes.forward;
  return camera;
}

std::vector<Vec3> fittedPoints(const SceneWorld& start) {
  std::vector<Vec3> shown, moving;
  double ground_z = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < start.names.size(); ++i) {
    const BodyDescription& body = start.world.bodies()[i];
    const std::vector<Vec3> corners =
        cornersOf(start.world.solids()[static_cast<std::size_t>(body.solid)], start.world.states()[i].X_WB);
    if (body.is_static && start.looks[i].checker) {
      ground_z = std::min(ground_z, highest(corners));
      continue;
    }
    shown.insert(shown.end(), corners.begin(), corners.end());
    if (!body.is_static) moving.insert(moving.end(), corners.begin(), corners.end());
  }
  for (const Vec3& p : moving)
    if (p.z() > ground_z) shown.emplace_back(p.x(), p.y(), ground_z);
  return shown;
}

CameraPath::CameraPath(const SceneCamera& camera, const SceneWorld& start, double aspect) : camera_(camera) {
  if (auto* follow = std::get_if<FollowBody>(&camera_.motion)) {
    body_ = bodyNamed(follow->body, start.names);
    const auto solid = static_cast<std::size_t>(start.world.bodies()[body_].solid);
    if (!follow->offset_m)
      follow->offset_m = kRadiiAway * start.world.solids()[solid].radius() * FitView().direction.normalized();
    return;
  }
  const auto* fit = std::get_if<FitView>(&camera_.motion);
  auto* orbit = std::get_if<Orbit>(&camera_.motion);
  if (fit == nullptr && !(orbit != nullptr && orbit->fits)) return;
  const std::vector<Vec3> points = fittedPoints(start);
  if (points.empty()) return;  // Nothing but ground.
  const Vec3 direction = fit != nullptr ? fit->direction : FitView().direction;
  const renderer::Camera fitted = fittedCamera(points, {direction, camera_.fov_degrees, aspect});
  camera_.eye = fitted.eye;
  camera_.target = fitted.target;
  if (orbit == nullptr) return;
  const Vec3 from_target = fitted.eye - fitted.target;
  orbit->radius_m = from_target.head<2>().norm();
  orbit->height_m = from_target.z();
}

renderer::Camera CameraPath::at(double time_s, std::span<const BodyState> bodies) const {
  renderer::Camera camera = camera_;
  if (const auto* follow = std::get_if<FollowBody>(&camera_.motion)) {
    camera.target = bodies[body_].X_WB.position;
    camera.eye = camera.target + *follow->offset_m;
  } else if (const auto* orbit = std::get_if<Orbit>(&camera_.motion)) {
    // The whole turns are taken off first: fmod is exact.
    const double degrees = orbit->start_degrees + std::fmod(orbit->degrees_per_second * time_s, 360.0);
    const SineCosine turn = sineCosine(radians(degrees));
    camera.eye =
        camera.target + Vec3(orbit->radius_m * turn.cosine, orbit->radius_m * turn.sine, orbit->height_m);
  }
  return camera;
}

}  // namespace carom::demos
