#pragma once
// The light of a scene: one of the renderer's by name, and what the scene changes of it.

#include <optional>
#include <string>

#include "renderer/look/light.h"

namespace carom::demos {

struct SceneLight {
  std::string name = "day";
  bool changed = false;  ///< The scene has values of its own.
  renderer::Light light;
};

/// Empty for the usual one, "sunset", or "sunset, towards 1 0 1, exposure 1.2" with all of its values.
std::string lightText(const SceneLight& light);

/// The scene's, or the one that is asked for by name; an exposure that is asked for goes over either's.
SceneLight chosenLight(const SceneLight& of_scene, const std::string& name,
                       const std::optional<double>& exposure);

}  // namespace carom::demos
