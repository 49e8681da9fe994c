#pragma once
// The pinhole camera: which pixel shows a point of the world. Pixel coordinates run from (0, 0), the top left
// corner of the image, to (width, height); the middle of pixel (x, y) is (x + 0.5, y + 0.5). The renderer
// computes in frame E: the world's axes with the origin at the camera's eye, so that single precision
// suffices far from the world's origin. Tested in tests/renderer/view/projection_test.cpp.

#include <array>
#include <optional>

#include "engine/foundation/frames.h"

namespace carom::renderer {

struct Camera {
  Vec3 eye = Vec3(6.0, -9.0, 5.0);  ///< World, metres, z up.
  Vec3 target = Vec3(0.0, 0.0, 1.0);
  double fov_degrees = 40.0;  ///< Vertical.
  double aperture_m =
      0.0;               ///< Of the lens, across; 0: everything is sharp. For presets of several exposures.
  double focus_m = 0.0;  ///< How far along the view things are sharp; 0: the target is.
};

/// The camera's axes in the world: unit, `right` x `up` = -`forward`.
struct CameraAxes {
  Vec3 right;
  Vec3 up;
  Vec3 forward;
};
/// Image-up leans to the world's +z, and to +y when the camera looks straight up or down. Throws InputError
/// when eye or target is not finite, when they coincide, or when the field of view is not within (0, 180)
/// degrees.
CameraAxes cameraAxes(const Camera& camera);

/// The focal length in pixels: half the image's height over the tangent of half the field of view.
double focalLengthPixels(const Camera& camera, int height);

/// The camera with its eye at a place on the lens, whose radius is 1, right and up; `shift_px` grows by how
/// far its image has to move, right and up, for what is in focus to stay where it is.
Camera throughLens(const Camera& camera, const Vec2& lens, int height, Vec2& shift_px);

/// Where `p_W` is drawn, whether or not that lies inside the image; nothing for a point beside or behind the
/// eye.
std::optional<Vec2> projectToPixel(const Camera& camera, int width, int height, const Vec3& p_W);

/// Distances along the view axis between which things are drawn, metres.
struct DepthRange {
  double near_m = 0.1;
  double far_m = 1000.0;
};
/// Column-major clip_from_E of GL: x right, y up, depth -1 at near and 1 at far.
std::array<float, 16> clipFromE(const Camera& camera, int width, int height, const DepthRange& range);

}  // namespace carom::renderer
