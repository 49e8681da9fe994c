#pragma once
// Reads scene files (JSON with comments; assets/scene.schema.json describes them). Whatever is misspelt,
// missing or out of range is an InputError of one line with file, line, JSON path, the value, and what is
// accepted. Tested in tests/demos/language/scene_file_test.cpp.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "demos/scene/scene.h"
#include "engine/foundation/contract.h"

namespace carom::demos {

/// All that is wrong with a scene's file; `what` is what was met first, which follows from nothing else.
class SceneMistakes : public InputError {
 public:
  SceneMistakes(const std::string& message, std::vector<std::string> mistakes)
      : InputError(message), all(std::move(mistakes)) {}
  std::vector<std::string>
      all;  ///< "file:line:column: path: what is wrong; how to write it", in the file's order.
};

/// `settings` are "path=value" (scene_expansion.h).
Scene readSceneFile(const std::filesystem::path& path, const std::vector<std::string>& settings = {});

/// Reads a scene from a text; `path` names it in messages and is where its meshes are looked for.
Scene parseScene(std::string_view text, const std::filesystem::path& path,
                 const std::vector<std::string>& settings = {});

}  // namespace carom::demos
