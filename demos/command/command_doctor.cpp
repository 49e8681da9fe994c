// `carom doctor`: what this machine gives the program, tried rather than believed.
#include "demos/command/command.h"

#include "demos/asset/asset_path.h"
#include "demos/command/renderer_examination.h"
#include "demos/language/scene_file.h"
#include "demos/scene/scene_world.h"
#include "demos/system/build_info.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

void examineAssets() {
  int scenes = 0;
  for (const std::filesystem::path& path : shippedScenes()) {
    makeSceneWorld(readSceneFile(path), std::nullopt);
    ++scenes;
  }
  if (scenes == 0) throw InputError(assetsFolder().string() + ": holds no scenes");
  tellFact("assets", assetsFolder().string() + " (" + std::to_string(scenes) + " scenes, all valid)");
}

}  // namespace

ExitCode doctor(const DoctorOptions& options) {
  tellFact("carom", programVersion() + " (" + buildName() + ")");
  tellFact("CPU", cpuClass());
  for (const auto& [library, version] : libraryVersions())
    if (!version.empty()) tellFact(library, version);
  examineAssets();
  examineRenderer(options.gl);
  tellFact("missing", "nothing");
  return ExitCode::kOk;
}

}  // namespace carom::demos
