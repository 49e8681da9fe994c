#pragma once
// Where a scene's camera is in a frame: a function of the frame's time and of the bodies' states there, and
// of the scene, so that any frame can be drawn without those before it, from a recording as well. Tested in
// tests/demos/scene/camera_path_test.cpp, tests/demos/scene/moving_cameras_test.cpp and
// tests/demos/scene/run_extent_test.cpp.

#include <optional>
#include <span>

#include "demos/formula/curved_path.h"
#include "demos/scene/scene_camera.h"
#include "demos/scene/scene_world.h"

namespace carom::demos {

struct FitRequest {
  Vec3 direction = Vec3(6.0, -9.0, 4.0);  ///< Towards the eye, any length.
  double fov_degrees = 40.0;              ///< Vertical.
  double aspect = 16.0 / 9.0;             ///< Width over height of the image.
  double fill = 11.0 / 12.0;              ///< Of the width or height, whichever the points take more of.
  double left_out = 0.0;                  ///< The share of points that may be beyond each side of that.
};
/// The nearest camera with this direction that has all points, but those left out, within that share of its
/// picture. At least two points that differ.
renderer::Camera fittedCamera(std::span<const Vec3> points, const FitRequest& request);

/// What a fitting camera shows: the boxes around all bodies but the grounds, as they are at the start, and
/// where those that move would come down on the lowest ground.
std::vector<Vec3> fittedPoints(const SceneWorld& start);

class CameraPath {
 public:
  /// `start` is the world as it is at the start; it need not outlive this. Throws InputError for a body that
  /// is not there. A camera that frames what moves runs the scene once, here.
  CameraPath(const SceneCamera& camera, const SceneWorld& start, double aspect);

  /// The camera at a time, with the bodies in the states that they have then. Where its eye meets its target
  /// it looks as it did on the way there.
  renderer::Camera at(double time_s, std::span<const BodyState> bodies) const;

 private:
  bool standAt(const FitRequest& request, const std::vector<Vec3>& points);
  renderer::Camera alongKeyframes(double time_s) const;
  renderer::Camera alongDolly(double time_s, const Vec3& body) const;
  renderer::Camera written(double time_s, const Vec3& body) const;
  Vec3 directionNear(double time_s, const BodyState& body) const;

  SceneCamera camera_;
  std::size_t body_ = 0;  // followed, or looked at
  std::optional<CurvedPath> curve_;
  double first_s_ = 0.0, last_s_ = 0.0;  // between which the eye moves by itself
};

}  // namespace carom::demos
