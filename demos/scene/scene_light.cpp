#include "demos/scene/scene_light.h"

#include <sstream>

namespace carom::demos {

std::string lightText(const SceneLight& light) {
  if (!light.changed) return light.name == "day" ? "" : light.name;
  const renderer::Light& l = light.light;
  std::ostringstream text;
  text << light.name;
  const auto add = [&](const char* name, const Vec3& v) {
    text << ", " << name << ' ' << v.x() << ' ' << v.y() << ' ' << v.z();
  };
  add("towards", l.to_light);
  add("sun", l.sun);
  add("sky", l.sky_light);
  add("horizon", l.horizon);
  add("zenith", l.zenith);
  text << ", softness " << l.softness << ", exposure " << l.exposure;
  return text.str();
}

SceneLight chosenLight(const SceneLight& of_scene, const std::string& name,
                       const std::optional<double>& exposure) {
  SceneLight light = name.empty() ? of_scene : SceneLight{name, false, renderer::lightOf(name)};
  if (exposure) {
    light.changed = light.changed || light.light.exposure != *exposure;
    light.light.exposure = *exposure;
  }
  return light;
}

}  // namespace carom::demos
