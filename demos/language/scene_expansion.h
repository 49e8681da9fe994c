#pragma once
// What a person writes once and means often: variables ("set"), arithmetic ("=2*r"), loops ("for"), groups
// with a pose and parts of other files ("include") become a plain scene without them. Every value keeps the
// place where it was written, for messages. Tested in tests/demos/language/scene_expansion_test.cpp.

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "demos/format/json.h"
#include "engine/foundation/frames.h"

namespace carom::demos {

struct ExpandedBody {
  Json json;
  bool in_group = false;
  Pose X_WG;                   ///< Of its group: what its own pose and velocities are given in.
  std::filesystem::path file;  ///< It was written in, beside which its meshes are looked for.
};

struct ExpandedScene {
  Json scene;  ///< Its members but for "set", "include" and "bodies", reckoned out.
  bool has_bodies = false;
  Json bodies;  ///< The list as it was written, for messages.
  std::vector<ExpandedBody> expanded;
  std::map<std::string, double> numbers;  ///< The variables of "set" that are numbers.
  std::vector<std::filesystem::path> included;
  std::vector<std::string> warnings;  ///< "file:line:column: path: what is written and has no effect".
};

/// Adds to `grown` how many values it made, also where it throws InputError.
ExpandedScene expandScene(const Json& scene, const std::filesystem::path& file, std::size_t& grown);

/// "set.r=0.1", "bodies.crate.position=[0,0,3]", "rate=480": puts the value into the scene; a body, camera or
/// material goes by its name, an item of any list by its number. Throws UsageError where there is no such
/// place, and for a variable that neither the scene nor a file that it includes at its top has.
Json withSetting(Json scene, const std::filesystem::path& file, const std::string& setting);

}  // namespace carom::demos
