#pragma once
// The light of a scene: where the sun stands, what it and the sky give, how the sky looks. Plain values; the
// shaders, here and on pages, have them as constants. Tested in
// tests/renderer/look/light_test.cpp.

#include <string>
#include <vector>

#include "engine/foundation/frames.h"

namespace carom::renderer {

/// Colours are linear. What a white face gives back that looks at the sun is `sun` and a part of the others.
struct Light {
  Vec3 to_light = Vec3(0.50, -0.50, 0.85);  ///< World, any length: where the sun stands.
  Vec3 sun = Vec3(1.76, 1.67, 1.53);
  Vec3 sky_light = Vec3(0.32, 0.365, 0.44);      ///< From above.
  Vec3 ground_light = Vec3(0.10, 0.097, 0.095);  ///< From below.
  Vec3 horizon = Vec3(0.615, 0.665, 0.735);      ///< The sky as it appears on the image; the air far away.
  Vec3 zenith = Vec3(0.24, 0.37, 0.59);
  Vec3 below = Vec3(0.45, 0.47, 0.50);  ///< Under the horizon, where there is no ground.
  Vec3 glow = Vec3::Zero();             ///< Added to the sky about the sun.
  double exposure = 1.0;                ///< Factor of all light on its way to the image.
  double softness = 1.0;                ///< Of the sun's disc over a preset's own.
  double pool =
      0.0;  ///< How far from the camera's target the light reaches, over their distance; 0: everywhere.
  bool operator==(const Light&) const = default;
};

/// "day", "studio-dark", "sunset", "overcast".
const std::vector<std::string>& lightNames();
/// The one of that name, which must be one of them.
Light lightOf(const std::string& name);

/// The lines by which the shaders know it (renderer/glsl/light.glsl): its values, as constants.
std::string shaderLines(const Light& light);

/// What `image`, a colour on the film, becomes with that exposure.
Vec3 exposed(const Vec3& image, double exposure);

}  // namespace carom::renderer
