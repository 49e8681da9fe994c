#pragma once
// A scene whose duration holds no step has nothing to simulate: `carom simulate` and `carom check` refuse it
// in the same line. Tested in tests/demos/program/program_test.cpp.

#include "demos/language/scene_choice.h"
#include "demos/scene/scene.h"

namespace carom::demos {

/// Throws InputError for a duration that the scene itself gives, UsageError for one that was asked for.
void requireAStep(const SceneChoice& choice, const Scene& scene);

}  // namespace carom::demos
