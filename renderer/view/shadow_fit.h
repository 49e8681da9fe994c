#pragma once
// Which part of the world the shadow map covers: the casters' bounds seen from the light, cut to what the
// camera can see. The map's square is snapped to a coarse grid of its own texels and grows in steps, so that
// shadows of still bodies don't crawl while others move, and most frames have the map of the one before;
// nothing depends on earlier frames. Tested in tests/renderer/view/shadow_fit_test.cpp.

#include <array>
#include <span>

#include "renderer/view/projection.h"

namespace carom::renderer {

/// A box that casts a shadow: pose in E (the world's axes, origin at the eye) and half sizes.
struct ShadowCaster {
  Pose X_EB;
  Vec3 half = Vec3::Zero();
};

/// An orthographic view along the light. Texture coordinates (u, v, depth) of a point are rows * (p_E, 1),
/// each within [0, 1] for what the map covers; depth grows away from the light. Without a shadow to see,
/// `texel_m` is 0.
struct ShadowView {
  Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
  double texel_m = 0.0;  ///< Side of a texel in the world.
};

struct ShadowRequest {
  Camera camera;
  double aspect = 1.0;  ///< Width over height of the image.
  Vec3 to_light = Vec3::UnitZ();
  int texels = 1024;  ///< Along each side of the map.
};
ShadowView fitShadow(const ShadowRequest& request, std::span<const ShadowCaster> casters);

/// The corners, in order, of the part of the level plane z = `ground_z_E` that the map covers: x and y in E.
/// Infinite or not a number for a light along the plane.
std::array<Vec2, 4> coveredGround(const ShadowView& view, double ground_z_E);

}  // namespace carom::renderer
