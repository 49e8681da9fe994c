#include "demos/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "demos/format/nearest_name.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/elementary.h"
#include "renderer/view/solid_extent.h"

namespace carom::demos {
namespace {

using std::numbers::pi;
constexpr double kRadiiAway = 6.0;   // Of a followed body.
constexpr double kFewBeyond = 0.01;  // Of what moves: a stray body may leave a framed picture.

double radians(double degrees) {
  return degrees * pi / 180.0;
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
/// The greatest of the values, once a share of them is left out.
double greatestBut(double left_out, std::vector<double> values) {
  const auto beyond = static_cast<std::ptrdiff_t>(left_out * static_cast<double>(values.size()));
  const auto at = values.begin() + beyond;
  std::nth_element(values.begin(), at, values.end(), std::greater<>());
  return *at;
}
Slab fitBetweenSides(std::span<const Vec3> points, const Vec3& across, const Vec3& along, double slope,
                     double left_out) {
  std::vector<double> lows, highs;
  for (const Vec3& p : points) {
    lows.push_back(p.dot(across) - slope * p.dot(along));
    highs.push_back(p.dot(across) + slope * p.dot(along));
  }
  const double low = greatestBut(left_out, std::move(lows));
  for (double& high : highs) high = -high;
  const double high = -greatestBut(left_out, std::move(highs));
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
  const double up_slope = request.fill * half.sine / half.cosine;
  const Slab sides =
      fitBetweenSides(points, axes.right, axes.forward, up_slope * request.aspect, request.left_out);
  const Slab top_and_bottom = fitBetweenSides(points, axes.up, axes.forward, up_slope, request.left_out);
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
    std::vector<Vec3> corners;
    renderer::addCorners(renderer::solidExtent(start.drawn(i)), start.world.states()[i].X_WB, corners);
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
    if (!follow->offset_m)
      follow->offset_m = kRadiiAway * start.drawnRadius(body_) * FitView().direction.normalized();
  } else if (const auto* dolly = std::get_if<Dolly>(&camera_.motion)) {
    if (dolly->body) body_ = bodyNamed(*dolly->body, start.names);
    curve_.emplace(dolly->points);
    first_s_ = dolly->start_s;
    last_s_ = dolly->start_s + dolly->seconds;
  } else if (const auto* path = std::get_if<CameraKeyframes>(&camera_.motion)) {
    first_s_ = path->keys.front().time_s;
    last_s_ = path->keys.back().time_s;
  } else if (const auto* moving = std::get_if<FrameMoving>(&camera_.motion)) {
    std::vector<Vec3> points = start.movedPoints();
    if (points.empty()) points = fittedPoints(start);  // Nothing moves.
    standAt({moving->direction, camera_.fov_degrees, aspect, moving->fill, kFewBeyond}, points);
  } else if (const auto* fit = std::get_if<FitView>(&camera_.motion)) {
    standAt({fit->direction, camera_.fov_degrees, aspect}, fittedPoints(start));
  } else if (auto* orbit = std::get_if<Orbit>(&camera_.motion); orbit != nullptr && orbit->fits) {
    if (!standAt({FitView().direction, camera_.fov_degrees, aspect}, fittedPoints(start))) return;
    const Vec3 from_target = camera_.eye - camera_.target;
    orbit->radius_m = from_target.head<2>().norm();
    orbit->height_m = from_target.z();
  }
}

bool CameraPath::standAt(const FitRequest& request, const std::vector<Vec3>& points) {
  if (points.empty()) return false;  // Nothing but ground.
  const renderer::Camera fitted = fittedCamera(points, request);
  camera_.eye = fitted.eye;
  camera_.target = fitted.target;
  return true;
}

renderer::Camera CameraPath::alongKeyframes(double time_s) const {
  const auto& path = std::get<CameraKeyframes>(camera_.motion);
  std::vector<double> times, values(path.keys.size());
  for (const CameraKeyframes::Key& key : path.keys) times.push_back(key.time_s);
  const auto valueOf = [&](const auto& numberOf) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = numberOf(path.keys[k].camera);
    return path.smooth ? monotoneAt(times, values, time_s) : linearAt(times, values, time_s);
  };
  renderer::Camera camera = camera_;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    camera.eye[axis] = valueOf([axis](const renderer::Camera& key) { return key.eye[axis]; });
    camera.target[axis] = valueOf([axis](const renderer::Camera& key) { return key.target[axis]; });
  }
  camera.fov_degrees = valueOf([](const renderer::Camera& key) { return key.fov_degrees; });
  return camera;
}

renderer::Camera CameraPath::alongDolly(double time_s, const Vec3& body) const {
  const auto& dolly = std::get<Dolly>(camera_.motion);
  const double share = (time_s - dolly.start_s) / dolly.seconds;
  renderer::Camera camera = camera_;
  camera.eye = curve_->at(dolly.eased ? easedShare(share) : share);
  if (dolly.body) camera.target = body;
  return camera;
}

/// As the scene says, with the followed body's centre of mass there.
renderer::Camera CameraPath::written(double time_s, const Vec3& body) const {
  if (std::holds_alternative<CameraKeyframes>(camera_.motion)) return alongKeyframes(time_s);
  if (std::holds_alternative<Dolly>(camera_.motion)) return alongDolly(time_s, body);
  renderer::Camera camera = camera_;
  if (const auto* follow = std::get_if<FollowBody>(&camera_.motion)) {
    camera.target = body;
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

/// From the eye to the target at the nearest time before, or else after, at which they are apart; the body
/// goes there at the velocity that it has. A function of the path, the time and the body's state, so that a
/// frame has the same camera whichever others are drawn.
Vec3 CameraPath::directionNear(double time_s, const BodyState& body) const {
  constexpr double kSoonest = 1e-9;  // of the path's duration
  constexpr int kDoublings = 40;     // up to a thousand durations
  const double moving_s = std::clamp(time_s, first_s_, last_s_);
  for (const double sign : {-1.0, 1.0}) {
    double by_s = sign * kSoonest * (last_s_ - first_s_);
    for (int k = 0; k < kDoublings; ++k, by_s *= 2.0) {
      const Vec3 there = body.X_WB.position + by_s * body.linear_velocity;
      const renderer::Camera camera = written(moving_s + by_s, there);
      const Vec3 direction = camera.target - camera.eye;
      if (direction.norm() > kSmallestLength_m) return direction.normalized();
    }
  }
  return -FitView().direction.normalized();  // They are never apart.
}

renderer::Camera CameraPath::at(double time_s, std::span<const BodyState> bodies) const {
  const BodyState body = bodies.empty() ? BodyState() : bodies[body_];
  renderer::Camera camera = written(time_s, body.X_WB.position);
  const bool goes_along_a_path = last_s_ > first_s_;
  if (goes_along_a_path && !((camera.target - camera.eye).norm() > kSmallestLength_m))
    camera.target = camera.eye + kSmallestLength_m * directionNear(time_s, body);
  return camera;
}

}  // namespace carom::demos
