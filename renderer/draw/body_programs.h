#pragma once
// The programs that draw bodies, one for each look, linked when first needed. Tested through the frames of
// tests/renderer/frame/frame_renderer_test.cpp.

#include <map>
#include <string>
#include <utility>

#include "renderer/draw/draw_list.h"
#include "renderer/gl/gl_functions.h"
#include "renderer/view/view.h"

namespace carom::renderer {

class BodyPrograms {
 public:
  /// `gl` must outlive this. `has_pictures`: some surface shows one (picture_array.h).
  BodyPrograms(const GlFunctions& gl, const Settings& settings, bool has_pictures);

  GLuint of(const BodyLook& look) { return of(look, false); }
  /// As the ground mirrors it.
  GLuint mirrored(const BodyLook& look) { return of(look, true); }

 private:
  GLuint of(const BodyLook& look, bool mirrored);

  const GlFunctions& gl_;
  std::string lines_;
  std::map<std::pair<BodyLook, bool>, GLuint> programs_;
};

}  // namespace carom::renderer
