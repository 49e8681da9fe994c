// `carom check`: validates a scene or a mesh without drawing anything.
#include "demos/command/command.h"

#include <iostream>

#include "demos/asset/asset_path.h"
#include "demos/asset/mesh_solid.h"
#include "demos/command/stepless_scene.h"
#include "demos/format/content_hash.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "demos/scene/shape_solid.h"

namespace carom::demos {
namespace {

// Lists all overlaps of a scene that has some.
SceneWorld checkedWorld(const Scene& scene, const SceneChoice& choice) {
  try {
    return makeSceneWorld(scene, choice.mesh);
  } catch (const OverlapsAtStart& refused) {
    for (const std::string& pair : refused.pairs) std::cout << pair << '\n';
    throw;
  }
}

// Lists all mistakes of a file that has some.
Scene checkedScene(const SceneChoice& choice) {
  try {
    return chosenScene(choice);
  } catch (const SceneMistakes& refused) {
    if (refused.all.size() > 1)
      for (const std::string& mistake : refused.all) std::cout << mistake << '\n';
    throw;
  }
}

void checkScene(const SceneChoice& choice) {
  const Scene scene = checkedScene(choice);
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  const SceneWorld made = checkedWorld(scene, choice);
  requireAStep(choice, scene);
  int moving = 0, kinematic = 0;
  for (const BodyDescription& body : made.world.bodies()) {
    moving += body.is_static ? 0 : 1;
    kinematic += body.is_kinematic;
  }
  std::cout << scene.file.string() << ": ok  " << made.world.bodies().size() << " bodies (" << moving
            << " move" << (kinematic > 0 ? ", " + std::to_string(kinematic) + " of them kinematic" : "")
            << ")  " << made.world.solids().size() << " solids  " << scene.cameras.size() << " cameras  "
            << scene.duration_s << " s at " << scene.rate_hz << " steps/s  scene hash "
            << hexText(sceneHash(scene, choice.mesh)) << '\n';
  for (const auto& [body, mesh] : made.meshes)
    std::cout << "  \"" << body << "\": " << mesh.file << ": " << mesh.text() << '\n';
}

void checkMesh(const std::filesystem::path& path, bool as_hull) {
  MeshSolid mesh = meshSolid(path, {.as_hull = as_hull});
  // A scene may scale it.
  try {
    requireLengths(cornersOf(mesh.parts), "mesh");
  } catch (const InputError& refused) {
    std::cerr << "warning: " << path.string() << ": " << refused.what() << '\n';
  }
  int vertices = 0, faces = 0;
  for (const ConvexPart& part : mesh.parts) {
    vertices += part.core.vertexCount();
    faces += part.core.faceCount();
  }
  const Solid solid(std::move(mesh.parts), std::move(mesh.surface));
  std::cout << path.string() << ": ok  " << solid.parts().size()
            << (solid.parts().size() == 1 ? " part  " : " parts  ") << vertices << " vertices  " << faces
            << " faces  volume " << solid.volume() << "  radius " << solid.radius() << "  centre of mass "
            << (-solid.origin_B()).transpose() << "  " << mesh.report.text() << '\n';
}

/// A scene is a .json file or a shipped name; any other file is a mesh.
bool isMesh(const std::string& what) {
  std::error_code ignored;
  const std::filesystem::path path(what);
  return path.extension() != ".json" && (path.has_extension() || std::filesystem::exists(path, ignored));
}

}  // namespace

ExitCode check(const CheckOptions& options) {
  const SceneChoice& choice = options.choice;
  if (isMesh(choice.scene)) {
    if (!choice.settings.empty() || choice.mesh)
      throw UsageError(std::string(choice.mesh ? "--mesh" : "--set") + " is for scenes: " + choice.scene +
                       " is a mesh itself");
    checkMesh(choice.scene, choice.as_hull);
  } else {
    checkScene(choice);
  }
  return ExitCode::kOk;
}

}  // namespace carom::demos
