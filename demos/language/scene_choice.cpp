// The scene that the command line chose, with its overrides put in, and the camera.
#include "demos/language/scene_choice.h"

#include <algorithm>
#include <string_view>

#include "demos/asset/asset_path.h"
#include "demos/format/nearest_name.h"
#include "demos/language/scene_file.h"
#include "demos/system/exit_code.h"
#include "demos/system/machine_load.h"

namespace carom::demos {

int threadsOf(const SceneChoice& choice) {
  constexpr int kMost = 8;
  return choice.threads > 0 ? choice.threads : std::min(processors(), kMost);
}

namespace {

/// Whether there is a mesh that --hull speaks of.
bool takeHull(Shape& shape) {
  bool any = false;
  if (auto* compound = std::get_if<CompoundShape>(&shape.form))
    for (CompoundPart& part : compound->parts) any = takeHull(part.shape) || any;
  auto* hull = std::get_if<HullShape>(&shape.form);
  if (hull == nullptr || !hull->replaceable) return any;
  if (!hull->as_hull) hull->as_hull = hull->told_hull = true;
  return true;
}

void takeHulls(Scene& scene) {
  bool any = false;
  for (Body& body : scene.bodies) any = takeHull(body.shape) || any;
  if (!any)
    throw InputError(scene.file.string() + ": takes no --hull: no mesh in it says \"replaceable\": true");
}

}  // namespace

Scene chosenScene(const SceneChoice& choice) {
  Scene scene = readSceneFile(findScene(choice.scene), choice.settings);
  if (choice.seed) scene.seed = *choice.seed;
  if (choice.duration_s) scene.duration_s = *choice.duration_s;
  if (choice.as_hull) takeHulls(scene);
  if (!choice.written.empty()) requireNotRead(choice.written, filesOf(scene, choice.mesh));
  return scene;
}

namespace {

/// The cameras that every scene has, unless it has its own of that name: "auto", "fit", "orbit" and
/// "follow:BODY".
std::optional<SceneCamera> builtInCamera(const Scene& scene, const std::string& name) {
  constexpr std::string_view kFollow = "follow:";
  SceneCamera camera;
  if (name == "auto") {
    camera.motion = FrameMoving{};
  } else if (name == "fit") {
    camera.motion = FitView{};
  } else if (name == "orbit") {
    camera.motion = Orbit{.fits = true};
  } else if (name.starts_with(kFollow)) {
    const std::string body = name.substr(kFollow.size());
    std::vector<std::string> names;
    for (const Body& known : scene.bodies)
      for (int copy = 0; copy < known.repeat.total(); ++copy) names.push_back(nameOfCopy(known, copy));
    if (std::find(names.begin(), names.end(), body) == names.end())
      throw UsageError("--camera " + name + ": no such body in " + scene.file.string() +
                       acceptedNames(body, names));
    camera.motion = FollowBody{body, {}};
  } else {
    return std::nullopt;
  }
  return camera;
}

}  // namespace

NamedCamera chosenCamera(const Scene& scene, const std::string& name) {
  const auto main = scene.cameras.find("main");
  auto chosen = main != scene.cameras.end() ? main : scene.cameras.begin();
  if (!name.empty()) chosen = scene.cameras.find(name);
  if (chosen != scene.cameras.end()) return {chosen->first, chosen->second};
  if (const std::optional<SceneCamera> camera = builtInCamera(scene, name)) return {name, *camera};
  std::vector<std::string> names;
  for (const auto& [known, unused] : scene.cameras) names.push_back(known);
  names.insert(names.end(), {"auto", "fit", "orbit", "follow:BODY"});
  throw UsageError("--camera " + name + ": no such camera in " + scene.file.string() +
                   acceptedNames(name, names));
}

}  // namespace carom::demos
