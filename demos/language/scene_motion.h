#pragma once
// What a scene says of how a body is moved: kinematic ones and their keyframes, locked axes, loads, mass.
// Tested in tests/demos/language/scene_file_test.cpp.

#include "demos/format/json.h"
#include "demos/scene/scene.h"

namespace carom::demos {

void readMotion(const Json& json, Body& body);
/// Refuses what cannot be said together, once the whole body is read and stands in the world.
void requireOneMotion(const Json& json, const Body& body);

}  // namespace carom::demos
