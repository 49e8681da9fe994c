#pragma once
// Compiles and links GLSL. Tested through the frames of tests/renderer/frame/frame_renderer_test.cpp.

#include <array>

#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

struct ShaderSources {
  const char* name;                   ///< For the message when the driver rejects it.
  std::array<const char*, 5> vertex;  ///< The stage's text, in pieces, null after the last.
  std::array<const char*, 8> fragment;
};

/// A program that lives as long as the current context. Throws NoRenderer with the first line of the driver's
/// log.
GLuint linkProgram(const GlFunctions& gl, const ShaderSources& sources);

}  // namespace carom::renderer
