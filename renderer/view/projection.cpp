#include "renderer/view/projection.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

// Below this sine between the view axis and the world's z the image's up comes from y.
constexpr double kStraightDown = 1e-6;

}  // namespace

CameraAxes cameraAxes(const Camera& camera) {
  if (!camera.eye.allFinite() || !camera.target.allFinite())
    throw InputError("camera: eye and target must be finite");
  if (!(camera.fov_degrees > 0.0 && camera.fov_degrees < 180.0)) {
    std::ostringstream message;
    message << "camera: field of view " << camera.fov_degrees << " is not between 0 and 180 degrees";
    throw InputError(message.str());
  }
  const Vec3 view = camera.target - camera.eye;
  const double distance = view.norm();
  if (!(distance > 0.0)) throw InputError("camera: eye and target are the same point");
  const Vec3 forward = view / distance;
  Vec3 right = forward.cross(Vec3::UnitZ());
  if (right.norm() < kStraightDown) right = forward.cross(Vec3::UnitY());
  right.normalize();
  return {right, right.cross(forward), forward};
}

double focalLengthPixels(const Camera& camera, int height) {
  return 0.5 * height / std::tan(0.5 * camera.fov_degrees * std::numbers::pi / 180.0);
}

Camera throughLens(const Camera& camera, const Vec2& lens, int height, Vec2& shift_px) {
  if (!(camera.aperture_m > 0.0)) return camera;
  const CameraAxes axes = cameraAxes(camera);
  const Vec2 aside = 0.5 * camera.aperture_m * lens;
  const double focus_m = camera.focus_m > 0.0 ? camera.focus_m : (camera.target - camera.eye).norm();
  Camera moved = camera;
  const Vec3 by = aside.x() * axes.right + aside.y() * axes.up;
  moved.eye += by;
  moved.target += by;
  shift_px += focalLengthPixels(camera, height) / focus_m * aside;
  return moved;
}

std::optional<Vec2> projectToPixel(const Camera& camera, int width, int height, const Vec3& p_W) {
  const CameraAxes axes = cameraAxes(camera);
  const Vec3 p_E = p_W - camera.eye;
  const double depth = p_E.dot(axes.forward);
  if (!(depth > 0.0)) return std::nullopt;
  const double scale = focalLengthPixels(camera, height) / depth;
  return Vec2(0.5 * width + scale * p_E.dot(axes.right), 0.5 * height - scale * p_E.dot(axes.up));
}

std::array<float, 16> clipFromE(const Camera& camera, int width, int height, const DepthRange& range) {
  const CameraAxes axes = cameraAxes(camera);
  const double focal = focalLengthPixels(camera, height);
  const double n = range.near_m, f = range.far_m;
  Eigen::Matrix4d m;
  m << (2.0 * focal / width) * axes.right.transpose(), 0.0, (2.0 * focal / height) * axes.up.transpose(), 0.0,
      ((f + n) / (f - n)) * axes.forward.transpose(), -2.0 * f * n / (f - n), axes.forward.transpose(), 0.0;
  std::array<float, 16> columns{};
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) columns[static_cast<std::size_t>(4 * c + r)] = static_cast<float>(m(r, c));
  return columns;
}

}  // namespace carom::renderer
