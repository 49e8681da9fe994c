#include "renderer/look/light.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/foundation/contract.h"

namespace carom::renderer {
namespace {

std::string constant(const char* name, const Vec3& value) {
  char line[160];
  std::snprintf(line, sizeof line, "const vec3 %s = vec3(%.9g, %.9g, %.9g);\n", name, value.x(), value.y(),
                value.z());
  return line;
}

std::string constant(const char* name, double value) {
  char line[80];
  std::snprintf(line, sizeof line, "const float %s = float(%.9g);\n", name, value);
  return line;
}

}  // namespace

const std::vector<std::string>& lightNames() {
  static const std::vector<std::string> names{"day", "studio-dark", "sunset", "overcast"};
  return names;
}

Light lightOf(const std::string& name) {
  Light light;
  if (name == "day") return light;
  if (name == "studio-dark") {
    light.to_light = Vec3(0.62, -0.50, 1.00);
    light.sun = Vec3(1.85, 1.76, 1.62);
    light.sky_light = Vec3(0.11, 0.12, 0.145);
    light.ground_light = Vec3(0.035, 0.035, 0.037);
    light.horizon = Vec3(0.0045, 0.0049, 0.0060);
    light.zenith = Vec3(0.0020, 0.0022, 0.0030);
    light.below = Vec3(0.0030, 0.0032, 0.0040);
    light.softness = 2.0;
    light.pool = 0.62;
  } else if (name == "sunset") {
    light.to_light = Vec3(0.90, -0.30, 0.36);
    light.sun = Vec3(2.80, 1.55, 0.70);
    light.sky_light = Vec3(0.30, 0.29, 0.40);
    light.ground_light = Vec3(0.13, 0.095, 0.075);
    light.horizon = Vec3(0.72, 0.44, 0.30);
    light.zenith = Vec3(0.125, 0.165, 0.33);
    light.below = Vec3(0.33, 0.24, 0.21);
    light.glow = Vec3(0.28, 0.14, 0.02);
  } else {
    REQUIRE(name == "overcast", name);
    light.to_light = Vec3(0.30, -0.35, 1.00);
    light.sun = Vec3(0.46, 0.47, 0.48);
    light.sky_light = Vec3(0.90, 0.93, 0.98);
    light.ground_light = Vec3(0.27, 0.27, 0.265);
    light.horizon = Vec3(0.70, 0.72, 0.745);
    light.zenith = Vec3(0.47, 0.505, 0.555);
    light.below = Vec3(0.48, 0.49, 0.50);
    light.softness = 5.0;
  }
  return light;
}

std::string shaderLines(const Light& light) {
  const auto image = [&](const Vec3& color) { return exposed(color, light.exposure); };
  std::string lines;
  if (!light.glow.isZero(0.0)) lines += "#define GLOW\n" + constant("kGlow", image(light.glow));
  if (light.pool > 0.0) lines += "#define POOL\n";
  return lines + constant("kSun", light.sun) + constant("kSkyLight", light.sky_light) +
         constant("kGroundLight", light.ground_light) + constant("kHorizon", image(light.horizon)) +
         constant("kZenith", image(light.zenith)) + constant("kBelow", image(light.below)) +
         constant("kExposure", light.exposure);
}

Vec3 exposed(const Vec3& image, double exposure) {
  if (exposure == 1.0) return image;
  const auto film = [](double light) { return light / std::sqrt(1.0 + light * light); };
  Vec3 shown;
  for (int i = 0; i < 3; ++i) {
    const double known = std::min(image[i], 0.999);
    shown[i] = film(exposure * known / std::sqrt(1.0 - known * known));
  }
  return shown;
}

}  // namespace carom::renderer
