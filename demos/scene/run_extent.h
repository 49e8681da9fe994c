#pragma once
// Where a scene's bodies get to in its whole run, for cameras that frame it. The scene is simulated once, to
// the duration of its file, so that the answer depends on nothing but the scene: any part of a job, worker or
// recording of it has the same. It costs as much as the physics of the run, and nothing else. Tested in
// tests/demos/scene/run_extent_test.cpp.

#include <filesystem>
#include <optional>
#include <vector>

#include "demos/scene/scene.h"

namespace carom::demos {

/// The corners of the boxes around every body that is not static, at some dozens of moments of the run, the
/// first and the last among them; fewer moments for a great many bodies. Throws what stepping throws, and
/// Interrupted.
std::vector<Vec3> pointsOfTheRun(const Scene& scene, const std::optional<std::filesystem::path>& mesh,
                                 int threads);

}  // namespace carom::demos
