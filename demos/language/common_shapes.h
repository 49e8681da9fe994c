#pragma once
// Shapes that a scene names instead of listing their corners: cylinder, cone, prism, wedge and roundedBox,
// each about the origin of its frame, along z. Round ones are polygons with so many sides that all of them
// touch the circle. Tested in tests/demos/language/scene_expansion_test.cpp.

#include <string>

#include "demos/format/json.h"
#include "demos/scene/scene.h"

namespace carom::demos {

bool isCommonShape(const std::string& kind);
/// Throws InputError.
Shape readCommonShape(const std::string& kind, const Json& json);

}  // namespace carom::demos
