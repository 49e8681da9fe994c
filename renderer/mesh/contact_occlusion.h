#pragma once
// Contact shadows: where a body comes near a flat face of another, less light gets in between. For each such
// pair a polygon in the face, cut to the reach of the effect, is darkened by the distance to the near body's
// rounded box. Works alike for grounds, ramps, walls and piled bodies. Tested in
// tests/renderer/mesh/contact_occlusion_test.cpp.

#include <array>
#include <span>
#include <vector>

#include "renderer/view/solid_extent.h"

namespace carom::renderer {

/// A corner of a polygon that is darkened. Frame R is that of the near body's rounded box.
struct OcclusionVertex {
  float p_E[3];
  float p_R[3];
  float n_R[3];    ///< The face's normal.
  float half[3];   ///< Of the rounded box.
  float radius;    ///< Of the rounded box, metres.
  float reach;     ///< Distance at which the darkening ends, metres.
  float strength;  ///< Of the light, what is lost where the box touches from straight above.
};

using OcclusionTriangle = std::array<OcclusionVertex, 3>;

/// A body as seen by this pass.
struct OcclusionBody {
  const Solid* solid = nullptr;
  std::span<const RoundedBox> boxes;  ///< See occludingBoxes.
  Pose X_EB;                          ///< World axes, origin at the eye.
  double radius_m = 0.0;              ///< About the solid's origin.
  bool endless_ground = false;        ///< Its upward faces count as unbounded; it darkens nothing itself.
};

/// Triangles to draw over the scene. Only faces turned to the eye count, and only
/// effects that are larger than a pixel at `focal_px`, or than some pixels between bodies. Cost: bodies
/// sorted along x, then pairs that overlap there.
std::vector<OcclusionTriangle> contactOcclusion(std::span<const OcclusionBody> bodies, double focal_px);

}  // namespace carom::renderer
