#pragma once
// How pictures of a scene are drawn, the same for all that draw them: frames, budgets, galleries. Whoever
// wants another look changes the settings that come from here. Tested in
// tests/demos/frames/picture_settings_test.cpp.

#include <string>

#include "demos/scene/scene_light.h"
#include "renderer/view/view.h"

namespace carom::demos {

struct PictureChoice {
  int width = 1280;
  int height = 720;
  std::string gl = "auto";  ///< The backend's name.
  renderer::Preset preset = renderer::Preset::kRealtime;
};

/// In that light, which is the scene's or goes over it (chosenLight).
renderer::Settings pictureSettings(const SceneLight& light, const PictureChoice& choice);

}  // namespace carom::demos
