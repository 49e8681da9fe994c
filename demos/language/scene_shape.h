#pragma once
// Shapes of bodies, and what is drawn in their place. Those that a scene names instead of listing their
// corners (cylinder, cone, prism, wedge, roundedBox) are about the origin of their frame, along z; round ones
// are polygons with so many sides that all of them touch the circle. Tested in
// tests/demos/language/scene_expansion_test.cpp and scene_visual_test.cpp.

#include <filesystem>

#include "demos/format/json.h"
#include "demos/scene/scene.h"

namespace carom::demos {

/// Throw InputError; `file` is the scene's, beside which meshes are looked for.
Shape readShape(const Json& json, const std::filesystem::path& file);
Visual readVisual(const Json& json, const std::filesystem::path& file);

}  // namespace carom::demos
