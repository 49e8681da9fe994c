#pragma once
// Where shipped files are: $CAROM_ASSETS, else share/carom beside an installed program, else the assets
// folder of the source tree the program was built from. Tested in tests/demos/asset/asset_path_test.cpp.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carom::demos {

/// The assets folder; throws InputError when there is none, naming what to set.
std::filesystem::path assetsFolder();

/// The scene files that are shipped, by name.
std::vector<std::filesystem::path> shippedScenes();

/// The file of a scene given as a shipped name ("sliding") or as a path to a .json file. Throws InputError
/// with the nearest shipped name when there is no such scene.
std::filesystem::path findScene(const std::string& name_or_path);

/// A file named in a scene: beside that scene, else in the assets folder.
std::optional<std::filesystem::path> findBeside(const std::filesystem::path& scene_file,
                                                const std::string& name);

/// The bytes of a file; throws InputError when it cannot be read, or has more than 256 MB.
std::string readTextFile(const std::filesystem::path& path);

}  // namespace carom::demos
