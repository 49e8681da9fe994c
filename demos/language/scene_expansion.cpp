#include "demos/language/scene_expansion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "demos/asset/asset_path.h"
#include "demos/format/nearest_name.h"
#include "demos/formula/arithmetic.h"
#include "demos/language/scene_values.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace {

constexpr int kDeepestInclude = 8;
constexpr std::size_t kDeepestNaming = 100;   // variables that name each other before they are reckoned
constexpr std::size_t kTextOfAValue = 32;     // characters: so much longer, a text counts as one value more
constexpr std::size_t kValuesOfAFile = 1000;  // what it takes to open a file, beside the values in it

/// How many values there are in one, itself included.
std::size_t valuesIn(const Json& json) {
  std::size_t count = 1;
  if (json.kind() == Json::Kind::kString) count += json.asString().size() / kTextOfAValue;
  if (json.kind() == Json::Kind::kArray)
    for (const Json& item : json.items()) count += valuesIn(item);
  if (json.kind() == Json::Kind::kObject)
    for (const auto& [key, value] : json.members()) count += valuesIn(value);
  return count;
}

/// What a scene may grow to: as many values as a file may hold. A few lines of variables that name each
/// other, of loops or of files would else fill any memory.
class Allowance {
 public:
  explicit Allowance(std::size_t& grown) : grown_(grown) {}
  void spend(std::size_t values, const Json& place) {
    spent_ += values;
    grown_ += values;
    if (spent_ > static_cast<std::size_t>(kMostJsonValues))
      place.fail("here the scene grows to more than " + std::to_string(kMostJsonValues) +
                 " values; accepted: fewer turns, copies and files");
  }

 private:
  std::size_t& grown_;
  std::size_t spent_ = 0;
};

/// The variables that can be named at a place, the innermost last. Those of "set" are reckoned when they are
/// first named: one that a later file sets again counts in the earlier file too, and they stand in any order.
class Scope {
 public:
  struct Variable {
    std::string name;
    Json value;
  };
  explicit Scope(Allowance& allowance) : allowance_(&allowance) {}
  Allowance& allowance() { return *allowance_; }
  void push(Variable variable) { variables_.push_back(std::move(variable)); }
  void pop(std::size_t size) { variables_.resize(size); }
  bool isEmpty() const { return variables_.empty() && written_.empty(); }
  std::size_t size() const { return variables_.size(); }

  /// A variable as it is written; of one name the last counts, and it may name the one before.
  void define(const std::string& name, const Json& written) {
    Written& variable = written_[name];
    if (variable.ways.empty()) order_.push_back(name);
    variable.ways.push_back(written);
  }
  void reckonAll() {
    for (const std::string& name : order_)
      if (!written_.at(name).is_reckoned) reckon(name);
  }

  const Json* find(const std::string& name) {
    used_.insert(name);
    const Json* value = known(name);
    return value != nullptr || written_.count(name) == 0 ? value : reckon(name);
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const std::string& name : order_)
      if (!written_.at(name).is_reckoned) all.push_back(name);
    for (const Variable& variable : variables_) all.push_back(variable.name);
    return all;
  }
  bool isUsed(const std::string& name) const { return used_.count(name) > 0; }

 private:
  const Json* known(const std::string& name) const {
    for (auto at = variables_.rbegin(); at != variables_.rend(); ++at)
      if (at->name == name) return &at->value;
    return nullptr;
  }
  const Json* reckon(const std::string& name);

  struct Written {
    std::vector<Json> ways;  ///< In which it is written; the last one counts.
    bool is_reckoned = false;
  };
  struct InWork {
    std::string name;
    std::size_t earlier = 0;  ///< How often it was written before.
  };
  Allowance* allowance_;
  std::vector<Variable> variables_;
  std::map<std::string, Written> written_;
  std::vector<std::string> order_;  ///< Names in the order in which they were written first.
  std::vector<InWork> in_work_;     ///< Each is named by the one before.
  std::list<Json> earlier_;         ///< Values of what a variable of the same name took over.
  std::set<std::string> used_;
};

/// The value with all arithmetic in it done.
Json resolved(const Json& json, Scope& scope);

double reckoned(const std::string& text, const Json& place, Scope& scope) {
  const NamedNumber numberOf = [&](const std::string& name) -> std::optional<double> {
    const Json* value = scope.find(name);
    if (value == nullptr) return std::nullopt;
    if (value->kind() != Json::Kind::kNumber)
      place.fail("\"" + name + "\" is " + value->shown() +
                 ", with which nothing can be reckoned; accepted: a number");
    return value->asNumber();
  };
  try {
    return evaluate(text, numberOf, [&] { return scope.names(); });
  } catch (const JsonError&) {
    throw;
  } catch (const InputError& error) {
    place.fail(place.shown() + ": " + error.what());
  }
}

/// The value of a variable as a part of a name: whole numbers without a point.
std::string asPartOfName(const Json& value) {
  return value.kind() == Json::Kind::kString ? value.asString() : value.text();
}

/// "step {i}" with what is in braces reckoned out.
std::string filledIn(const std::string& text, const Json& place, Scope& scope) {
  std::string filled;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at);
    filled += text.substr(at, open == std::string::npos ? open : open - at);
    if (open == std::string::npos) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos)
      place.fail(place.shown() + ": a \"}\" is missing; accepted: \"name {i}\"");
    const std::string inner = text.substr(open + 1, close - open - 1);
    const Json* variable = isArithmeticName(inner) ? scope.find(inner) : nullptr;
    filled += asPartOfName(variable != nullptr ? *variable : Json(reckoned(inner, place, scope)));
    scope.allowance().spend(1 + filled.size() / kTextOfAValue, place);
    at = close + 1;
  }
  return filled;
}

Json resolvedText(const Json& json, Scope& scope) {
  const std::string& text = json.asString();
  if (!text.empty() && text[0] == '=') {
    const std::string inner = text.substr(1);
    const std::size_t begin = inner.find_first_not_of(' ');
    const std::size_t end = inner.find_last_not_of(' ');
    const std::string name = begin == std::string::npos ? "" : inner.substr(begin, end - begin + 1);
    if (isArithmeticName(name))
      if (const Json* value = scope.find(name)) {
        scope.allowance().spend(valuesIn(*value), json);
        return value->movedTo(json);
      }
    return Json(reckoned(inner, json, scope)).movedTo(json);
  }
  if (!scope.isEmpty() && text.find('{') != std::string::npos)
    return Json(filledIn(text, json, scope)).movedTo(json);
  return json;
}

Json resolved(const Json& json, Scope& scope) {
  scope.allowance().spend(1, json);
  switch (json.kind()) {
    case Json::Kind::kString:
      return resolvedText(json, scope);
    case Json::Kind::kArray: {
      Json list = Json::array();
      for (const Json& item : json.items()) list.push(resolved(item, scope));
      return list.placedAs(json);
    }
    case Json::Kind::kObject: {
      Json object = Json::object();
      for (const auto& [key, value] : json.members()) object.set(key, resolved(value, scope));
      return object.placedAs(json);
    }
    default:
      return json;
  }
}

/// While a variable is reckoned, its own name is what was written before it.
const Json* Scope::reckon(const std::string& name) {
  const bool is_itself = !in_work_.empty() && in_work_.back().name == name;
  const bool is_in_work =
      std::any_of(in_work_.begin(), in_work_.end(), [&](const InWork& outer) { return outer.name == name; });
  Written& variable = written_.at(name);
  const std::vector<Json>& all = variable.ways;
  const std::size_t count = is_itself ? in_work_.back().earlier : all.size();
  if (count == 0) return nullptr;
  const Json& written = all[count - 1];
  if (is_in_work && !is_itself) written.fail("\"" + name + "\" is reckoned from itself");
  if (in_work_.size() >= kDeepestNaming)
    written.fail("variables that name each other deeper than " + std::to_string(kDeepestNaming) + " levels");
  in_work_.push_back({name, count - 1});
  Json value = resolved(written, *this);
  in_work_.pop_back();
  if (is_itself) return &earlier_.emplace_back(std::move(value));
  variable.is_reckoned = true;
  variables_.push_back({name, std::move(value)});
  return &variables_.back().value;
}

/// Whether the name stands in the text by itself, not as a part of a longer one.
bool hasWord(const std::string& text, const std::string& name) {
  const auto isPart = [&](std::size_t at) {
    return at < text.size() && isArithmeticName("a" + text.substr(at, 1));
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
    if (!(at > 0 && isPart(at - 1)) && !isPart(at + name.size())) return true;
  return false;
}

void requireName(const Json& place, const std::string& name) {
  if (!isArithmeticName(name) || isArithmeticWord(name))
    place.fail("\"" + name +
               "\" is no name for a variable; accepted: letters, digits and _, not those of functions");
}

/// What a file and those that it includes at its top have in common; their variables are in a scope.
struct Common {
  std::set<std::string> given;  ///< Variables that whoever includes has set, whatever the files say.
  std::set<std::string> variables;
  std::vector<Json::Member> materials;  ///< Of the included files; later ones take the place of earlier.
};

class Expander {
 public:
  Expander(ExpandedScene& out, std::size_t& grown) : out_(out), allowance_(grown) {}

  void scene(const Json& json, const std::filesystem::path& file) {
    Scope scope(allowance_);
    out_.scene = Json::object().placedAs(json);
    Common common;
    takeCommon(json, file, scope, common);
    scope.reckonAll();
    for (const auto& [key, value] : json.members()) {
      if (key == "set" || key == "include" || key == "bodies" || key == "materials" || key == "$schema")
        continue;
      const bool is_plain = key == "description" || key == "group" || key == "lookFor" || key == "caption";
      out_.scene.set(key, is_plain ? value : resolved(value, scope));
    }
    takeNumbers(json.find("caption"), scope);
    const Json materials = takeMaterials(json, scope, common);
    if (!materials.members().empty()) out_.scene.set("materials", materials);
    if (const Json* bodies = json.find("bodies")) {
      out_.has_bodies = true;
      out_.bodies = *bodies;
      list(*bodies, scope, {Pose{}, false, "", file, nullptr});
    }
    if (const Json* set = json.find("set"))
      for (const auto& [name, value] : set->members())
        if (!scope.isUsed(name)) warn(value, "\"" + name + "\" is set and not used");
  }

  /// "include" at a file's top: variables and materials of other files, which its own take the place of.
  void takeCommon(const Json& json, const std::filesystem::path& file, Scope& scope, Common& common) {
    const Json include = json.find("include") != nullptr ? json.at("include") : Json::array();
    for (const Json& name : include.items()) {
      std::filesystem::path at;
      const Json other = readIncluded(name, file, at);
      ++depth_;
      takeCommon(other, at, scope, common);
      --depth_;
      if (const Json* own = other.find("materials"))
        common.materials.insert(common.materials.end(), own->members().begin(), own->members().end());
    }
    if (const Json* set = json.find("set")) takeVariables(*set, scope, common);
  }

 private:
  /// What the bodies of a list have in common.
  struct Surroundings {
    Pose X_WG;
    bool in_group = false;
    std::string prefix;
    std::filesystem::path file;
    const Json* materials = nullptr;  ///< Of the included file they were written in.
  };

  void warn(const Json& place, const std::string& message) {
    try {
      place.fail(message);
    } catch (const InputError& warning) {
      out_.warnings.push_back(warning.what());
    }
  }

  /// For the caption, whose figures are reckoned out in each frame: what it names is used.
  void takeNumbers(const Json* caption, Scope& scope) {
    const bool is_text = caption != nullptr && caption->kind() == Json::Kind::kString;
    for (const std::string& name : scope.names()) {
      const bool is_named = is_text && hasWord(caption->asString(), name);
      const Json* value = is_named ? scope.find(name) : nullptr;
      if (value != nullptr && value->kind() == Json::Kind::kNumber) out_.numbers[name] = value->asNumber();
    }
  }

  static void takeVariables(const Json& set, Scope& scope, Common& common) {
    for (const auto& [name, value] : set.members()) {
      requireName(value, name);
      common.variables.insert(name);
      if (common.given.count(name) == 0) scope.define(name, value);
    }
  }

  Json readIncluded(const Json& name, const std::filesystem::path& file, std::filesystem::path& found_at) {
    const std::optional<std::filesystem::path> found = findBeside(file, name.asString());
    if (!found) name.fail("no file " + name.shown() + " beside the scene or in the assets folder");
    if (static_cast<int>(depth_) >= kDeepestInclude)
      name.fail("files that include each other deeper than " + std::to_string(kDeepestInclude) + " levels");
    found_at = *found;
    out_.included.push_back(*found);
    allowance_.spend(kValuesOfAFile, name);
    Json other = Json::parse(readTextFile(*found), found->string());
    allowance_.spend(valuesIn(other), name);
    return other;
  }

  /// The file's materials, and those of the files that it includes, which its own take the place of.
  static Json takeMaterials(const Json& json, Scope& scope, const Common& common) {
    const Json* own = json.find("materials");
    Json all = own != nullptr ? resolved(*own, scope) : Json::object();
    for (auto at = common.materials.rbegin(); at != common.materials.rend(); ++at)
      if (all.find(at->first) == nullptr) all.set(at->first, resolved(at->second, scope));
    return all;
  }

  void list(const Json& bodies, Scope& scope, const Surroundings& around) {
    for (const Json& item : bodies.items()) {
      if (item.kind() == Json::Kind::kObject && item.find("for") != nullptr)
        loop(item, scope, around);
      else if (item.kind() == Json::Kind::kObject && item.find("include") != nullptr)
        include(item, scope, around);
      else if (item.kind() == Json::Kind::kObject && item.find("bodies") != nullptr)
        group(item, scope, around);
      else
        body(item, scope, around);
    }
  }

  /// {"for": {"i": 5, "j": [0.1, 0.3]}, "bodies": [...]}: every pair of values.
  void loop(const Json& item, Scope& scope, const Surroundings& around) {
    item.onlyKeys({"for", "bodies"});
    turn(item, item.at("for").members(), 0, scope, around);
  }

  void turn(const Json& item, const std::vector<Json::Member>& variables, std::size_t next, Scope& scope,
            const Surroundings& around) {
    if (next == variables.size()) {
      list(item.at("bodies"), scope, around);
      return;
    }
    const auto& [name, written] = variables[next];
    requireName(written, name);
    const Json values = resolved(written, scope);
    const bool is_count = values.kind() != Json::Kind::kArray;
    const int count = is_count ? readWhole(values, 0, kMostBodies) : static_cast<int>(values.items().size());
    for (int k = 0; k < count; ++k) {
      const std::size_t before = scope.size();
      allowance_.spend(1, written);
      scope.push({name, is_count ? Json(static_cast<double>(k)).movedTo(values)
                                 : values.items()[static_cast<std::size_t>(k)]});
      turn(item, variables, next + 1, scope, around);
      scope.pop(before);
    }
  }

  Surroundings within(const Json& item, Scope& scope, const Surroundings& around) const {
    Json placed = Json::object().placedAs(item);
    for (const char* key : {"name", "position", "rotation"})
      if (const Json* value = item.find(key)) placed.set(key, resolved(*value, scope));
    Surroundings inner = around;
    inner.X_WG = around.X_WG * readPose(placed);
    inner.X_WG.rotation.normalize();
    inner.in_group = true;
    if (const Json* name = placed.find("name")) inner.prefix += name->asString() + ".";
    return inner;
  }

  void group(const Json& item, Scope& scope, const Surroundings& around) {
    item.onlyKeys({"name", "position", "rotation", "bodies"});
    list(item.at("bodies"), scope, within(item, scope, around));
  }

  /// The bodies of another file with its variables, of which "set" changes some.
  void include(const Json& item, Scope& scope, const Surroundings& around) {
    item.onlyKeys({"include", "name", "position", "rotation", "set"});
    Surroundings inner = within(item, scope, around);
    const Json other = readIncluded(item.at("include"), around.file, inner.file);
    Scope own(allowance_);
    Common common;
    const Json changed = item.find("set") != nullptr ? item.at("set") : Json::object();
    for (const auto& [name, value] : changed.members()) {
      own.push({name, resolved(value, scope)});
      common.given.insert(name);
    }
    ++depth_;
    takeCommon(other, inner.file, own, common);
    for (const auto& [name, value] : changed.members())
      if (common.variables.count(name) == 0)
        value.fail("\"" + name + "\" is no variable of " + item.at("include").shown());
    own.reckonAll();
    const Json materials = takeMaterials(other, own, common);
    inner.materials = &materials;
    list(other.at("bodies"), own, inner);
    --depth_;
  }

  void body(const Json& item, Scope& scope, const Surroundings& around) {
    if (out_.expanded.size() >= kMostBodies) item.fail("more bodies than " + std::to_string(kMostBodies));
    const Json whole = resolved(item, scope);
    if (whole.kind() != Json::Kind::kObject)
      item.fail(item.shown() + " is no body; accepted: {\"name\": ..., \"shape\": ...}");
    Json json = Json::object().placedAs(whole);
    for (const auto& [key, value] : whole.members()) {
      const bool is_text = value.kind() == Json::Kind::kString;
      if (key == "name" && is_text && !around.prefix.empty())
        json.set(key, Json(around.prefix + value.asString()).movedTo(value));
      else if (key == "material" && is_text && around.materials != nullptr &&
               around.materials->find(value.asString()) != nullptr)
        json.set(key, *around.materials->find(value.asString()));
      else
        json.set(key, value);
    }
    out_.expanded.push_back({std::move(json), around.in_group, around.X_WG, around.file});
  }

  ExpandedScene& out_;
  Allowance allowance_;
  std::size_t depth_ = 0;
};

// Settings: a path of keys, names and numbers.

std::vector<std::string> pathWords(const std::string& path) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : path) {
    if (c == '.' || c == '[' || c == ']') {
      if (!word.empty()) words.push_back(std::exchange(word, ""));
    } else {
      word += c;
    }
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

std::string nameIn(const Json& item) {
  const Json* name = item.kind() == Json::Kind::kObject ? item.find("name") : nullptr;
  return name != nullptr && name->kind() == Json::Kind::kString ? name->asString() : "";
}

class Setter {
 public:
  Setter(const std::string& setting, std::vector<std::string> words, Json value)
      : setting_(setting), words_(std::move(words)), value_(std::move(value)) {}

  Json put(const Json& json, std::size_t next) const {
    if (next == words_.size()) return value_.movedTo(json);
    const std::string& word = words_[next];
    if (json.kind() == Json::Kind::kArray) return putIntoList(json, next);
    if (json.kind() != Json::Kind::kObject)
      throw UsageError("--set " + setting_ + ": nothing is in " + json.path() + ", which is " + json.shown());
    Json changed = Json::object().placedAs(json);
    bool found = false;
    for (const auto& [key, member] : json.members()) {
      changed.set(key, key == word ? put(member, next + 1) : member);
      found = found || key == word;
    }
    // What is left out in the file can be given; whether the key is one is the scene reader's matter.
    if (!found) {
      if (next + 1 < words_.size()) refuse(json, word, keysOf(json));
      changed.set(word, value_.movedInto(json, word));
    }
    return changed;
  }

 private:
  Json putIntoList(const Json& json, std::size_t next) const {
    const std::string& word = words_[next];
    const bool is_number = word.find_first_not_of("0123456789") == std::string::npos;
    Json changed = Json::array().placedAs(json);
    std::vector<std::string> names;
    bool found = false;
    for (std::size_t i = 0; i < json.items().size(); ++i) {
      const Json& item = json.items()[i];
      const bool is_it = is_number ? word == std::to_string(i) : nameIn(item) == word;
      changed.push(is_it ? put(item, next + 1) : item);
      found = found || is_it;
      names.push_back(nameIn(item).empty() ? std::to_string(i) : nameIn(item));
    }
    if (!found) refuse(json, word, names);
    return changed;
  }
  static std::vector<std::string> keysOf(const Json& json) {
    std::vector<std::string> keys;
    for (const auto& [key, unused] : json.members()) keys.push_back(key);
    return keys;
  }
  [[noreturn]] void refuse(const Json& json, const std::string& word,
                           const std::vector<std::string>& names) const {
    throw UsageError("--set " + setting_ + ": " + (json.path().empty() ? "the scene" : json.path()) +
                     " has no \"" + word + "\"" + acceptedNames(word, names));
  }

  const std::string& setting_;
  std::vector<std::string> words_;
  Json value_;
};

/// A variable that no file of the scene knows would have no effect.
void requireVariable(const Json& scene, const std::filesystem::path& file, const std::string& setting,
                     const std::string& name) {
  const Json* set = scene.find("set");
  if (set != nullptr && set->find(name) != nullptr) return;
  ExpandedScene out;
  std::size_t grown = 0;
  Allowance allowance(grown);
  Scope scope(allowance);
  Common common;
  Expander(out, grown).takeCommon(scene, file, scope, common);
  if (common.variables.count(name) == 0)
    throw UsageError(
        "--set " + setting + ": \"" + name + "\" is no variable of the scene" +
        acceptedNames(name, std::vector<std::string>(common.variables.begin(), common.variables.end())));
}

/// JSON where it is that, else a text: --set bodies.crate.color=#ff0000.
Json valueOf(const std::string& text, const std::string& setting) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size())
    throw UsageError("--set " + setting + ": " + text +
                     " is beyond double precision; accepted: -1.8e308 to 1.8e308");
  try {
    return Json::parse(text, "");
  } catch (const InputError&) {
    return Json(text);
  }
}

}  // namespace

ExpandedScene expandScene(const Json& scene, const std::filesystem::path& file, std::size_t& grown) {
  ExpandedScene out;
  Expander(out, grown).scene(scene, file);
  return out;
}

Json withSetting(Json scene, const std::filesystem::path& file, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::vector<std::string> words = pathWords(setting.substr(0, equals));
  if (equals == std::string::npos || words.empty())
    throw UsageError("--set " + setting + ": accepted: PATH=VALUE such as bodies.crate.position=[0,0,3]");
  if (words.size() > 1 && words[0] == "set") {
    requireVariable(scene, file, setting, words[1]);
    if (scene.find("set") == nullptr) scene.set("set", Json::object().movedInto(scene, "set"));
  }
  return Setter(setting, words, valueOf(setting.substr(equals + 1), setting)).put(scene, 0);
}

}  // namespace carom::demos
