#include "demos/language/scene_mistakes.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "demos/language/scene_remedies.h"
#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

const Json* valueAt(const Json& json, const std::string& path) {
  if (json.path() == path) return &json;
  if (json.kind() == Json::Kind::kArray)
    for (const Json& item : json.items())
      if (const Json* found = path.rfind(item.path(), 0) == 0 ? valueAt(item, path) : nullptr) return found;
  if (json.kind() == Json::Kind::kObject)
    for (const auto& [key, value] : json.members())
      if (const Json* found = path.rfind(value.path(), 0) == 0 ? valueAt(value, path) : nullptr) return found;
  return nullptr;
}

bool isOfTwoBodies(const JsonError& error) {
  return std::string(error.what()).find("names two bodies") != std::string::npos;
}

/// Behind the key, where it stands in the path as a whole: "].name" in "bodies[0].name", not in
/// "bodies[0].names".
std::optional<std::size_t> endOfKey(const std::string& path, const std::string& key,
                                    const std::string& followers = ".[") {
  for (std::size_t at = path.find(key); at != std::string::npos; at = path.find(key, at + 1)) {
    const std::size_t end = at + key.size();
    if (end == path.size() || followers.find(path[end]) != std::string::npos) return end;
  }
  return std::nullopt;
}

/// The item of a list of bodies that makes others, when the mistake is in what makes it such an item: nothing
/// can be said of what is left of it.
std::optional<std::string> makerOfBodies(const std::string& path) {
  for (const std::string key : {"include", "for", "bodies"})
    if (const std::optional<std::size_t> end = endOfKey(path, "]." + key, "."))
      return path.substr(0, *end - key.size() - 1);
  return std::nullopt;
}

/// What is taken out for a mistake: a member, or an item that is an object; never one number of a vector, and
/// whole whatever has keys that are in place of each other. A body whose name is another's has been read.
std::string taken(const Json& json, const JsonError& error) {
  std::string path = error.spot.path;
  if (path.rfind("cameras.", 0) == 0) return path.substr(0, path.find('.', std::string("cameras.").size()));
  if (path.rfind("fluids[", 0) == 0) return path.substr(0, path.find(']') + 1);
  if (const std::optional<std::string> maker = makerOfBodies(path)) return *maker;
  if (isOfTwoBodies(error)) return path.substr(0, path.rfind('.'));
  for (const std::string part : {".repeat", ".rotation"})
    if (const std::optional<std::size_t> end = endOfKey(path, part)) return path.substr(0, *end);
  for (const Json* value = valueAt(json, path); !path.empty() && path.back() == ']';
       value = valueAt(json, path)) {
    if (value != nullptr && value->kind() == Json::Kind::kObject) break;
    path.resize(path.rfind('['));
  }
  return path;
}

/// Whether the mistake follows from another that was taken out before.
bool isConsequence(const JsonError& error, const std::set<std::string>& gone) {
  const std::string message = error.what();
  const auto has = [&message](const std::string& part) { return message.find(part) != std::string::npos; };
  for (const std::string& path : gone) {
    const std::size_t dot = path.rfind('.');
    const std::string owner = dot == std::string::npos ? "" : path.substr(0, dot);
    const std::string key = dot == std::string::npos ? path : path.substr(dot + 1);
    if (error.spot.path == owner && (has("key \"" + key + "\" is missing") || !has("is missing")))
      return true;
    if (path.rfind("bodies", 0) == 0 && (has("unknown body") || has("at least one body"))) return true;
    if (path.rfind("materials", 0) == 0 && has("unknown material")) return true;
    if (path.rfind("set", 0) == 0 && has("unknown name")) return true;
    if (path == "include" && (has("unknown name") || has("unknown material"))) return true;
  }
  return false;
}

/// What stands for a shape, a name or a path that was refused, so that the rest of its body is read.
Json placeholder(const std::string& key, const JsonError::Spot& spot) {
  if (key == "name") return Json("mistake " + std::to_string(spot.line) + ":" + std::to_string(spot.column));
  if (key == "kinematic") return Json(true);
  return Json::object({{"box", Json::array({1.0, 1.0, 1.0})}});
}

Json withMember(const Json& json, const std::string& path, const std::string& key, const Json& value) {
  Json changed = json;
  if (json.kind() == Json::Kind::kArray) {
    changed = Json::array().placedAs(json);
    for (const Json& item : json.items()) changed.push(withMember(item, path, key, value));
  } else if (json.kind() == Json::Kind::kObject) {
    changed = Json::object().placedAs(json);
    for (const auto& [name, member] : json.members())
      if (json.path() != path || name != key) changed.set(name, withMember(member, path, key, value));
    if (json.path() == path) changed.set(key, value);
  }
  return changed;
}

/// The body's key that the mistake is of, where a body cannot do without it; and the body's path.
std::optional<std::pair<std::string, std::string>> neededKey(const JsonError& error) {
  const std::string& path = error.spot.path;
  if (path.rfind("bodies[", 0) != 0 || isOfTwoBodies(error) || makerOfBodies(path)) return std::nullopt;
  for (const std::string key : {"shape", "name"}) {
    const std::optional<std::size_t> end = endOfKey(path, "]." + key);
    if (end && path.find(".compound") == std::string::npos)
      return {{path.substr(0, *end - key.size() - 1), key}};
    if (std::string(error.what()).find("key \"" + key + "\" is missing") != std::string::npos)
      return {{path, key}};
  }
  const std::size_t inside = path.find("].kinematic.");
  if (inside != std::string::npos) return {{path.substr(0, inside + 1), "kinematic"}};
  return std::nullopt;
}

/// A key that is missing because it was written otherwise: a mistake that is already told names it as what
/// was meant.
bool isMeantByAnother(const JsonError& error,
                      const std::vector<std::pair<JsonError::Spot, std::string>>& found) {
  const std::string message = error.what();
  const std::size_t end = message.find("\" is missing"), begin = message.rfind("key \"", end);
  if (end == std::string::npos || begin == std::string::npos) return false;
  const std::string key = message.substr(begin + 4, end + 1 - (begin + 4));
  const std::string owner = error.spot.path.empty() ? "" : error.spot.path + ".";
  for (const auto& [spot, told] : found)
    if (spot.path.rfind(owner, 0) == 0 && spot.path.find('.', owner.size()) == std::string::npos &&
        told.find(key) != std::string::npos)
      return true;
  return false;
}

/// What the remedy is for: of a colour's numbers the whole colour.
const Json* meantValue(const Json& json, const std::string& path) {
  const std::size_t color = path.rfind(".color[");
  return valueAt(json, color == std::string::npos ? path : path.substr(0, color + 6));
}

std::string withRemedy(const Json& json, const JsonError& error) {
  return error.what() + remedyFor(*meantValue(json, error.spot.path), error.what());
}

/// What is wrong with a value of the scene; none, too, where something else is.
std::optional<JsonError> firstOf(const Json& json, const std::function<void(const Json&)>& read) {
  try {
    read(json);
  } catch (const JsonError& error) {
    return error;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

}  // namespace

Mistakes mistakesOf(Json json, const std::filesystem::path& path, JsonError first, int most,
                    const std::function<void(const Json&)>& read) {
  std::vector<std::pair<JsonError::Spot, std::string>> found;
  std::set<std::string> gone;
  std::optional<JsonError> next = std::move(first);
  for (int i = 0; i < most && next; ++i) {
    const JsonError error = *next;
    next.reset();
    if (i > 0 && error.spot.origin.empty()) break;  // It is of a placeholder.
    const Json* value = error.spot.origin == path.string() ? valueAt(json, error.spot.path) : nullptr;
    const std::optional<std::pair<std::string, std::string>> needed = neededKey(error);
    const std::string out = needed ? needed->first + "." + needed->second : taken(json, error);
    if (value != nullptr && gone.count(out) > 0) break;
    if (!isConsequence(error, gone) && !isMeantByAnother(error, found))
      found.emplace_back(error.spot, value == nullptr ? error.what() : withRemedy(json, error));
    if (value == nullptr || i + 1 == most || out.empty()) break;
    gone.insert(out);
    json = needed ? withMember(json, needed->first, needed->second, placeholder(needed->second, error.spot))
                  : json.without(out);
    next = firstOf(json, read);
  }
  Mistakes mistakes{found.front().second, {}};
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
  });
  for (const auto& [spot, message] : found) mistakes.all.push_back(message);
  return mistakes;
}

}  // namespace carom::demos
