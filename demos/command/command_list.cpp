// `carom list`: the shipped scenes.
#include "demos/command/command.h"

#include <iomanip>
#include <iostream>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/language/scene_file.h"

namespace carom::demos {
namespace {

int bodyCount(const Scene& scene) {
  int count = 0;
  for (const Body& body : scene.bodies) count += body.repeat.total();
  return count;
}

Json sceneJson(const Scene& scene) {
  Json cameras = Json::array();
  for (const auto& [name, unused] : scene.cameras) cameras.push(name);
  return Json::object({{"name", scene.name},
                       {"description", scene.description},
                       {"bodies", bodyCount(scene)},
                       {"duration_s", scene.duration_s},
                       {"cameras", std::move(cameras)},
                       {"file", scene.file.string()}});
}

}  // namespace

ExitCode list(const ListOptions& options) {
  Json all = Json::array();
  for (const std::filesystem::path& path : shippedScenes()) {
    const Scene scene = readSceneFile(path);
    if (options.json) {
      all.push(sceneJson(scene));
    } else {
      std::cout << std::left << std::setw(24) << scene.name << std::right << std::setw(4) << bodyCount(scene)
                << " bodies " << std::setw(4) << scene.duration_s << " s  " << scene.description << '\n';
    }
  }
  if (options.json) std::cout << all.text(2) << '\n';
  return ExitCode::kOk;
}

}  // namespace carom::demos
