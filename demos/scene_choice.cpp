// The scene that the command line chose, with its overrides put in, and the camera.
#include "demos/command.h"

#include "demos/asset_path.h"
#include "demos/nearest_name.h"
#include "demos/scene_file.h"

namespace carom::demos {

Scene chosenScene(const SceneChoice& choice) {
  Scene scene = readSceneFile(findScene(choice.scene));
  if (choice.seed) scene.seed = *choice.seed;
  if (choice.duration_s) scene.duration_s = *choice.duration_s;
  return scene;
}

NamedCamera chosenCamera(const Scene& scene, const std::string& name) {
  const auto main = scene.cameras.find("main");
  auto chosen = main != scene.cameras.end() ? main : scene.cameras.begin();
  if (!name.empty()) chosen = scene.cameras.find(name);
  if (chosen != scene.cameras.end()) return {chosen->first, chosen->second};
  std::vector<std::string> names;
  for (const auto& [known, unused] : scene.cameras) names.push_back(known);
  throw UsageError("--camera " + name + ": no such camera in " + scene.file.string() +
                   acceptedNames(name, names));
}

}  // namespace carom::demos
