#pragma once
// A camera as a scene describes it: where it stands, and what moves it. camera_path.h says where it is in a
// frame.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "renderer/view/projection.h"

namespace carom::demos {

/// Stands where the whole scene is in the picture, seen from `direction`.
struct FitView {
  Vec3 direction = Vec3(6.0, -9.0, 4.0);  ///< Towards the eye, any length.
};

/// Looks at a body's centre of mass from `offset_m` beside it, without turning with it.
struct FollowBody {
  std::string body;
  std::optional<Vec3> offset_m;  ///< None: six radii of the body away.
};

/// Circles about the vertical through the camera's target, counter-clockwise seen from above.
struct Orbit {
  double radius_m = 8.0;
  double height_m = 3.0;  ///< Of the eye over the target.
  double degrees_per_second = 30.0;
  double start_degrees = -60.0;  ///< From the world's x axis.
  bool fits = false;             ///< Target, radius and height are those of a FitView instead.
};

/// Stands where all that moves, in the whole run, fills a share of the picture, seen from `direction`.
struct FrameMoving {
  Vec3 direction = Vec3(6.0, -9.0, 4.0);  ///< Towards the eye, any length.
  double fill = 2.0 / 3.0;                ///< Of the height or width, whichever it takes more of.
};

/// Exactly there at the keyframes' times; before the first where that is, after the last likewise.
struct CameraKeyframes {
  struct Key {
    double time_s = 0.0;
    renderer::Camera camera;
  };
  std::vector<Key> keys;  ///< Times rise.
  bool smooth = true;     ///< Else on straight lines at constant speeds.
};

/// Goes along a smooth curve through points, at one speed or, eased, from standstill to standstill.
struct Dolly {
  std::vector<Vec3> points;         ///< At least two, no two neighbours in one place.
  std::optional<std::string> body;  ///< It looks at; else the camera's target.
  double start_s = 0.0;
  double seconds = 5.0;
  bool eased = true;
};

/// A renderer's camera, which stands still, or what moves it; the field of view is always the camera's own.
struct SceneCamera : renderer::Camera {
  SceneCamera() = default;
  SceneCamera(const renderer::Camera& still) : renderer::Camera(still) {}
  std::variant<std::monostate, FitView, FollowBody, Orbit, FrameMoving, CameraKeyframes, Dolly> motion;

  bool moves() const {
    return std::holds_alternative<FollowBody>(motion) || std::holds_alternative<Orbit>(motion) ||
           std::holds_alternative<CameraKeyframes>(motion) || std::holds_alternative<Dolly>(motion);
  }
};

}  // namespace carom::demos
