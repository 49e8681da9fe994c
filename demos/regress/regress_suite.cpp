#include "demos/regress/regress_suite.h"

#include <set>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

std::vector<std::string> words(const Json& json, const char* key) {
  std::vector<std::string> texts;
  if (const Json* list = json.find(key))
    for (const Json& word : list->items()) texts.push_back(word.asString());
  return texts;
}

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// The name becomes a folder's.
void requireName(const Json& json, const std::string& name) {
  const std::string accepted = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  if (name.empty() || name[0] == '.' || name.find_first_not_of(accepted) != std::string::npos)
    json.fail("is " + json.shown() + "; accepted: letters, digits, - _ and .");
}

}  // namespace

RegressSuite readSuite(const std::filesystem::path& path) {
  std::error_code ignored;
  RegressSuite suite;
  suite.file = std::filesystem::is_directory(path, ignored) ? path / kSuiteName : path;
  const std::filesystem::path folder = suite.file.parent_path();
  const Json json = Json::parse(readTextFile(suite.file), suite.file.string());
  json.onlyKeys({"format", "render", "compare", "scenes"});
  const std::vector<std::string> render = words(json, "render"), compare = words(json, "compare");
  std::set<std::string> names;
  for (const Json& item : json.at("scenes").items()) {
    SuiteScene scene;
    const Json* name = &item;
    if (item.kind() == Json::Kind::kString) {
      scene.scene = scene.name = item.asString();
      scene.golden = folder / scene.name;
      scene.render = render;
      scene.compare = compare;
    } else {
      item.onlyKeys({"name", "scene", "golden", "render", "compare"});
      scene.scene = item.at("scene").asString();
      name = item.find("name") != nullptr ? item.find("name") : &item.at("scene");
      scene.name = name->asString();
      scene.golden = folder / (item.find("golden") != nullptr ? item.at("golden").asString() : scene.name);
      scene.render = joined(render, words(item, "render"));
      scene.compare = joined(compare, words(item, "compare"));
    }
    requireName(*name, scene.name);
    if (!names.insert(scene.name).second) name->fail("is " + name->shown() + " a second time");
    if (scene.scene.ends_with(".json")) scene.scene = (folder / scene.scene).string();
    suite.scenes.push_back(std::move(scene));
  }
  if (suite.scenes.empty()) json.at("scenes").fail("is empty; accepted: a scene or more");
  return suite;
}

}  // namespace carom::demos
