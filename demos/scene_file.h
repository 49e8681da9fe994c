#pragma once
// Reads scene files (JSON with comments; assets/scene.schema.json describes them). Whatever is misspelt,
// missing or out of range is an InputError of one line with file, line, JSON path, the value, and what is
// accepted. Tested in tests/demos/scene_file_test.cpp.

#include <filesystem>
#include <string_view>

#include "demos/scene.h"

namespace carom::demos {

Scene readSceneFile(const std::filesystem::path& path);

/// Reads a scene from a text; `path` names it in messages and is where its meshes are looked for.
Scene parseScene(std::string_view text, const std::filesystem::path& path);

}  // namespace carom::demos
