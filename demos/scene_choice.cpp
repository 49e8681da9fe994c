// The scene that the command line chose, with its overrides put in.
#include "demos/command.h"

#include "demos/asset_path.h"
#include "demos/scene_file.h"

namespace carom::demos {

Scene chosenScene(const SceneChoice& choice) {
  Scene scene = readSceneFile(findScene(choice.scene));
  if (choice.seed) scene.seed = *choice.seed;
  if (choice.duration_s) scene.duration_s = *choice.duration_s;
  return scene;
}

}  // namespace carom::demos
