#include "demos/frames/picture_settings.h"

namespace carom::demos {

renderer::Settings pictureSettings(const SceneLight& light, const PictureChoice& choice) {
  renderer::Settings settings{.width = choice.width, .height = choice.height};
  settings.light = light.light;
  settings.backend = renderer::backendOf(choice.gl);
  settings.preset = choice.preset;
  return settings;
}

}  // namespace carom::demos
