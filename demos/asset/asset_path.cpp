#include "demos/asset/asset_path.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "demos/format/nearest_name.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kLargestText = std::uintmax_t{256}
                                        << 20;  // kept in memory as a whole, thrice at times

bool isFile(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool isAssetsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path / "scenes", ignored);
}

/// bin/carom finds share/carom next to its folder.
fs::path installedAssets() {
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  return failed ? fs::path() : program.parent_path().parent_path() / "share" / "carom";
}

}  // namespace

fs::path assetsFolder() {
  if (const char* chosen = std::getenv("CAROM_ASSETS"); chosen != nullptr && *chosen != '\0') {
    if (!isAssetsFolder(chosen))
      throw InputError(std::string("CAROM_ASSETS=") + chosen + ": no folder with a \"scenes\" folder in it");
    return chosen;
  }
  for (const fs::path& folder : {installedAssets(), fs::path(CAROM_SOURCE_ASSETS)})
    if (isAssetsFolder(folder)) return folder;
  throw InputError("the assets folder is missing (looked at " CAROM_SOURCE_ASSETS
                   "); set CAROM_ASSETS to where it is");
}

std::vector<fs::path> shippedScenes() {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(assetsFolder() / "scenes"))
    if (entry.path().extension() == ".json") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

fs::path findScene(const std::string& name_or_path) {
  const bool looks_like_path =
      name_or_path.find('/') != std::string::npos || fs::path(name_or_path).extension() == ".json";
  if (looks_like_path) {
    if (!isFile(name_or_path)) throw InputError(name_or_path + ": no such scene file");
    return name_or_path;
  }
  const std::vector<fs::path> scenes = shippedScenes();
  std::vector<std::string> names;
  for (const fs::path& scene : scenes) {
    names.push_back(scene.stem().string());
    if (names.back() == name_or_path) return scene;
  }
  throw InputError("unknown scene \"" + name_or_path + "\"" + acceptedNames(name_or_path, names) +
                   ", or a path to a .json file");
}

std::optional<fs::path> findBeside(const fs::path& scene_file, const std::string& name) {
  const fs::path beside = scene_file.parent_path() / name;  // an absolute name replaces the folder
  if (isFile(beside)) return beside;
  const fs::path shipped = assetsFolder() / name;
  if (isFile(shipped)) return shipped;
  return std::nullopt;
}

std::string readTextFile(const fs::path& path) {
  const std::ifstream file = openInputFile(path);
  std::error_code failed;
  const std::uintmax_t size = fs::file_size(path, failed);
  if (!failed && size > kLargestText)
    throw InputError(path.string() + ": has " + std::to_string(size >> 20) + " MB; accepted: at most " +
                     std::to_string(kLargestText >> 20));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace carom::demos
