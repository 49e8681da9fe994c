#pragma once
// The lines that choose the variants of the shaders, put between the head and the rest of each (shaders.h);
// the light's values are among them, as constants (renderer/look). Tested in
// tests/renderer/draw/shaders_test.cpp.

#include <string>

#include "renderer/draw/draw_list.h"
#include "renderer/view/view.h"

namespace carom::renderer {

/// Of everything that a renderer with these settings draws.
std::string frameLines(const Settings& settings);

/// What bodies have besides; `mirrored`: as the ground mirrors them.
std::string bodyLines(const BodyLook& look, bool mirrored);

}  // namespace carom::renderer
