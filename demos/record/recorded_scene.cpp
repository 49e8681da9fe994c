#include "demos/record/recorded_scene.h"

#include "demos/format/content_hash.h"
#include "demos/scene/scene_world.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

SceneChoice recordedChoice(const RecordedMotion& recorded, SceneChoice choice, const std::string& remedy) {
  const RecordingHeader& header = recorded.header;
  if (choice.scene.empty()) {
    choice.scene = header.scene;
    std::error_code ignored;
    const std::filesystem::path file(header.scene);
    if (file.is_absolute() && !std::filesystem::exists(file, ignored))
      throw InputError(recorded.file.string() + ": its scene " + header.scene +
                       " is not there; accepted: " + remedy + " with where it is now");
  }
  if (!choice.mesh && !header.mesh.empty()) choice.mesh = header.mesh;
  choice.seed = header.seed;
  choice.duration_s = header.duration_s;
  return choice;
}

void requireSameScene(const RecordedMotion& recorded, const Scene& scene, const SceneChoice& choice) {
  const std::uint64_t hash = sceneHash(scene, choice.mesh);
  if (hash == recorded.header.scene_hash) return;
  throw InputError(recorded.file.string() + ": recorded from scene hash " +
                   hexText(recorded.header.scene_hash) + ", but " + scene.file.string() + " has " +
                   hexText(hash) + "; accepted: the scene as it was, or a new recording");
}

}  // namespace carom::demos
