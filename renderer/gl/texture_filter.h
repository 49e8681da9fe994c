#pragma once
// How a texture that a pass draws into is read by the next one. Tested with every frame that has shadows or a
// mirror.

#include "renderer/gl/gl_functions.h"

namespace carom::renderer {

/// The bound 2D texture is mixed between its texels, and continues beyond its edges as it is there.
inline void readSmoothly(const GlFunctions& gl) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace carom::renderer
