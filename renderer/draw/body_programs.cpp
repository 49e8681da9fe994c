#include "renderer/draw/body_programs.h"

#include "renderer/draw/shader_lines.h"
#include "renderer/draw/shaders.h"
#include "renderer/gl/shader_program.h"

namespace carom::renderer {

BodyPrograms::BodyPrograms(const GlFunctions& gl, const Settings& settings, bool has_pictures)
    : gl_(gl), lines_(frameLines(settings) + (has_pictures ? "#define PICTURES\n" : "")) {}

GLuint BodyPrograms::of(const BodyLook& look, bool mirrored) {
  const auto [at, is_new] = programs_.try_emplace({look, mirrored}, 0);
  if (is_new) at->second = linkProgram(gl_, sourcesOf(Shader::kBody, lines_ + bodyLines(look, mirrored)));
  return at->second;
}

}  // namespace carom::renderer
