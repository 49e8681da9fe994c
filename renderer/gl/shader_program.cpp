#include "renderer/gl/shader_program.h"

#include <array>
#include <span>
#include <string>
#include <vector>

#include "renderer/gl/offscreen_context.h"

namespace carom::renderer {
namespace {

[[noreturn]] void reject(const char* name, const char* what, std::string log) {
  log = log.substr(0, log.find('\n'));
  throw NoRenderer(std::string("the GL driver does not ") + what + " shader '" + name + "': " + log);
}

GLuint compile(const GlFunctions& gl, GLenum stage, const char* name, std::span<const char* const> pieces) {
  std::vector<const char*> texts;
  for (const char* piece : pieces)
    if (piece != nullptr) texts.push_back(piece);
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled != GL_TRUE) {
    std::array<char, 512> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    reject(name, "compile", log.data());
  }
  return shader;
}

}  // namespace

GLuint linkProgram(const GlFunctions& gl, const ShaderSources& sources) {
  const GLuint vertex = compile(gl, GL_VERTEX_SHADER, sources.name, sources.vertex);
  const GLuint fragment = compile(gl, GL_FRAGMENT_SHADER, sources.name, sources.fragment);
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex);
  gl.AttachShader(program, fragment);
  gl.LinkProgram(program);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::array<char, 512> log{};
    gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
    reject(sources.name, "link", log.data());
  }
  return program;
}

}  // namespace carom::renderer
