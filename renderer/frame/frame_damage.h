#pragma once
// Which pixels of the image, and which texels of the shadow map, may differ between two frames drawn from
// different inputs. A pixel follows from the bodies and triangles that cover it, in their order, and from
// what of the shadow map is looked up there: outside the damage these are the same in both frames, to the
// bit, however a change came about. Tested in tests/renderer/frame/frame_damage_test.cpp.

#include <span>

#include "renderer/draw/frame_inputs.h"
#include "renderer/view/damage.h"

namespace carom::renderer {

/// Which pixels a frame's shapes may cover, rounding included.
class ScreenBounds {
 public:
  ScreenBounds(const FrameBlock& block, int width, int height);

  /// Of the convex hull of points in E; the whole image where one is beside or behind the eye.
  GridBlock of(std::span<const Vec3> points_E) const;
  GridBlock of(const DrawnBody& body) const;
  GridBlock of(const GroundTriangle& triangle) const;
  GridBlock of(const OcclusionTriangle& triangle) const;

 private:
  Eigen::Matrix4d clip_from_E_;
  GridBlock image_;
  double ground_z_E_;
};

/// Which texels of the shadow map a caster may cover, rounding included.
GridBlock shadowMapBounds(const FrameBlock& block, const DrawnBody& caster, int texels);

struct FrameDamage {
  Damage image;
  Damage shadow_map;
};
struct FrameSizes {
  int width = 0;
  int height = 0;
  int shadow_texels = 0;
};
/// All of it.
FrameDamage wholeDamage(const FrameSizes& sizes);
FrameDamage frameDamage(const FrameInputs& before, const FrameInputs& now, const FrameSizes& sizes);

}  // namespace carom::renderer
