#pragma once
// Writes a scene as the JSON that scene_file.h reads, number for number: a scene that the explorer made or
// shrank is run from its own text, so the file it leaves repeats it with `carom simulate`. Cameras and looks
// are left out. Tested in tests/explore/random_world_test.cpp.

#include <string>

#include "demos/scene/scene.h"

namespace carom::explore {

std::string sceneText(const demos::Scene& scene);
/// The scene as its text is read: rotations are made unit once more.
demos::Scene readBack(const demos::Scene& scene);

}  // namespace carom::explore
