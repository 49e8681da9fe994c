#include "renderer/draw/shader_lines.h"

#include <algorithm>
#include <cstdio>

#include "renderer/view/preset.h"

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

std::string lightLines(const Light& light) {
  const auto image = [&](const Vec3& color) { return exposed(color, light.exposure); };
  std::string lines;
  if (!light.glow.isZero(0.0)) lines += "#define GLOW\n" + constant("kGlow", image(light.glow));
  if (light.pool > 0.0) lines += "#define POOL\n";
  return lines + constant("kSun", light.sun) + constant("kSkyLight", light.sky_light) +
         constant("kGroundLight", light.ground_light) + constant("kHorizon", image(light.horizon)) +
         constant("kZenith", image(light.zenith)) + constant("kBelow", image(light.below)) +
         constant("kExposure", light.exposure);
}

std::string define(const std::string& what, std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return 'a' <= c && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return "#define " + what + "_" + name + "\n";
}

}  // namespace

std::string frameLines(const Settings& settings) {
  const Quality quality = qualityOf(settings);
  std::string lines;
  if (settings.style == Style::kPrint) lines += "#define PRINT\n";
  if (settings.cutout) lines += "#define CUTOUT\n";
  if (!quality.soft_look_up) lines += "#define SMALL_SHADOWS\n";
  if (quality.mirror) lines += "#define POLISHED\n";
  return lines + constant("kOpaque", settings.cutout ? 0.0 : 1.0) + lightLines(settings.light);
}

std::string groundLines(GroundPattern pattern) {
  const bool has_noise = pattern == GroundPattern::kConcrete || pattern == GroundPattern::kPlanks ||
                         pattern == GroundPattern::kSand;
  return (has_noise ? "#define GROUND_NOISE\n" : "") + define("GROUND", nameOf(pattern));
}

std::string bodyLines(const BodyLook& look, bool mirrored) {
  std::string lines;
  if (mirrored) lines += "#define MIRROR\n";
  if (look.shader == BodyShader::kSunlit) lines += "#define SUNLIT\n";
  if (look.shader == BodyShader::kChecker)
    lines += "#define CHECKER\n" + groundLines(static_cast<GroundPattern>(look.finish));
  else if (look.finish != 0)
    lines += "#define SURFACE\n" + define("SURFACE", nameOf(static_cast<SurfaceKind>(look.finish)));
  return lines;
}

}  // namespace carom::renderer
