#pragma once
// How much a frame's beauty may cost, and for what it is drawn. Every preset has bevelled edges, soft and
// contact shadows, light from sky and ground and smoothed edges; dearer ones draw a frame several times, each
// time with the camera moved within its pixel and the sun within its disc, and take the mean of the light.
// Tested in tests/renderer/view/preset_test.cpp.

#include <string>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::renderer {

enum class Preset {
  kFast,       ///< Smaller shadow map, one filtered look-up.
  kRealtime,   ///< What golden frames show.
  kQuality,    ///< Four times the samples, a sun of 1.6 degrees, finer shadows.
  kCinematic,  ///< 16 times the samples, a sun of 6 degrees, a polished ground that mirrors bodies.
};
enum class Style {
  kDaylight,  ///< Sky, checkered ground, air to the horizon.
  kPrint,     ///< White background and ground, no air: for paper.
};

/// The names on command lines, in the order of the enumerations.
const std::vector<std::string>& presetNames();
const std::vector<std::string>& styleNames();
const std::string& nameOf(Preset preset);
const std::string& nameOf(Style style);
/// The one of that name, which must be one of them.
Preset presetOf(const std::string& name);
Style styleOf(const std::string& name);

/// What a preset means.
struct Quality {
  int shadow_texels = 1024;       ///< Along a side of the shadow map.
  bool soft_look_up = true;       ///< A tent of 4x4 texels, else 2x2.
  int samples = 1;                ///< Exposures of a frame, a power of two.
  double sun_half_angle = 0.0;    ///< Tangent of half the angle of the sun's disc.
  double ground_roughness = 0.0;  ///< How far mirrored things spread, over their height.
  bool mirror = false;            ///< Whether the ground mirrors bodies.
};
Quality qualityOf(Preset preset, Style style);

/// One exposure: where in its pixel the camera looks, where in its disc the sun stands, how the ground tilts
/// what it mirrors, where on its lens the camera has its eye.
struct Sample {
  Vec2 shift_px = Vec2::Zero();
  Vec3 to_light = Vec3::UnitZ();  ///< Unit.
  Vec2 mirror_shear = Vec2::Zero();
  Vec2 lens = Vec2::Zero();  ///< Where on the lens, whose radius is 1, the eye is: right, up.
};
/// As many as `quality` says, always the same; their mean shift is zero. A single one is exactly `to_light`,
/// unshifted.
std::vector<Sample> samplesOf(const Quality& quality, const Vec3& to_light);

}  // namespace carom::renderer
