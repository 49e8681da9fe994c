#include "renderer/draw/shader_lines.h"

#include "renderer/view/preset.h"

namespace carom::renderer {

std::string frameLines(const Settings& settings) {
  const Quality quality = qualityOf(settings);
  std::string lines;
  if (settings.style == Style::kPrint) lines += "#define PRINT\n";
  if (settings.cutout) lines += "#define CUTOUT\n";
  if (!quality.soft_look_up) lines += "#define SMALL_SHADOWS\n";
  if (quality.mirror) lines += "#define POLISHED\n";
  return lines + "const float kOpaque = " + (settings.cutout ? "0.0" : "1.0") + ";\n" +
         shaderLines(settings.light);
}

std::string bodyLines(const BodyLook& look, bool mirrored) {
  std::string lines;
  if (mirrored) lines += "#define MIRROR\n";
  if (look.shader == BodyShader::kSunlit) lines += "#define SUNLIT\n";
  if (look.shader == BodyShader::kChecker)
    lines += "#define CHECKER\n" + shaderLines(static_cast<GroundPattern>(look.finish));
  else
    lines += shaderLines(static_cast<SurfaceKind>(look.finish));
  return lines;
}

}  // namespace carom::renderer
