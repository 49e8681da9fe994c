#pragma once
// Which faces of a body need no look-up of shadows: those that nothing else can darken, and those turned away
// from the sun. Decided on the CPU from the bodies' bounds seen from the sun and from the faces' planes, so
// that a shadow is looked up only where one may fall. Conservative: a face that may be partly in shadow is
// never called sunlit. Tested in tests/renderer/mesh/face_light_test.cpp.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/solid/solid.h"
#include "renderer/view/shadow_fit.h"

namespace carom::renderer {

/// Faces by bit: bit f for face f, the last bit for whatever of a body belongs to no face of its own.
using FaceMask = std::uint32_t;
inline constexpr FaceMask kAllFaces = ~FaceMask{0};
inline constexpr int kNoFace = 31;  ///< The bit of what belongs to no face.

/// Whether light is decided face by face on this solid: one part with less than 32 faces, without rounding
/// and not curved. Another solid is drawn as a whole.
bool hasLitFaces(const Solid& solid);

/// Narrower on the image than this, a face would show in a pixel here and there.
inline constexpr double kSliver_px = 0.75;

/// The faces that the eye sees and that are no slivers, by their light; all of a solid that has no lit faces.
struct FaceLight {
  FaceMask sunlit = 0;    ///< Not darkened but by their own slant.
  FaceMask turned = 0;    ///< Turned away from the sun, beside a face that may be in shadow: without sun.
  FaceMask shadowed = 0;  ///< Shadows have to be looked up.
};

/// A body that casts shadows on others and is darkened by them.
struct ShadedBody {
  const Solid* solid = nullptr;
  Pose X_EB;
  ShadowCaster bounds;
};

/// The light on each of the bodies, all of which may darken each other, in the shadow map of `view`.
/// `to_light` is unit; `focal_px` tells slivers, 0: there are none. O(n log n) and a term for every two
/// bodies of which one may darken the other.
std::vector<FaceLight> faceLights(const ShadowView& view, const Vec3& to_light,
                                  std::span<const ShadedBody> bodies, double focal_px = 0.0);

}  // namespace carom::renderer
