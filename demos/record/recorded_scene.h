#pragma once
// The scene that a recording was made from. A recording names its scene and holds its hash, so that motion is
// never shown with bodies that it does not belong to. Tested in tests/demos/render/long_jobs_test.cpp and
// tests/demos/program/export_program_test.cpp.

#include <filesystem>
#include <string>

#include "demos/language/scene_choice.h"
#include "demos/record/recording.h"

namespace carom::demos {

struct RecordedMotion {
  const std::filesystem::path& file;
  const RecordingHeader& header;
};

/// The recording's scene, mesh, seed and duration; a scene or mesh that `choice` names says where it is now.
/// Throws InputError when the scene is not where it was, with `remedy` as what would be accepted.
SceneChoice recordedChoice(const RecordedMotion& recorded, SceneChoice choice, const std::string& remedy);

/// Throws InputError when `scene` is not, byte for byte, what was recorded.
void requireSameScene(const RecordedMotion& recorded, const Scene& scene, const SceneChoice& choice);

}  // namespace carom::demos
