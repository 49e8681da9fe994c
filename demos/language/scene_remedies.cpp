#include "demos/language/scene_remedies.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "demos/language/scene_values.h"

namespace carom::demos {
namespace {

/// A word that people try, and what it is here.
struct Word {
  const char* tried;
  const char* remedy;
};

constexpr const char* kFriction = "\"staticFriction\": 0.5 and \"dynamicFriction\": 0.4 in a material";
constexpr const char* kBounce = "\"restitution\": 0.5 in a material, 0 to 1";
constexpr const char* kMaterialOnly =
    "it in the body's \"material\", such as \"material\": {\"density\": 600}";
constexpr const char* kVelocity = "\"linearVelocity\": [x, y, z], m/s";
constexpr const char* kSpin = "\"angularVelocity\": [x, y, z], rad/s";
constexpr const char* kPosition = "\"position\": [x, y, z]";
constexpr const char* kRotation = "\"rotation\": {\"axis\": [0, 0, 1], \"degrees\": 45}";
constexpr const char* kStatic = "\"static\": true for what never moves, nothing for what does";
constexpr const char* kShape = "\"shape\": {\"box\": [1, 1, 1]}, or sphere, capsule, cylinder and others";
constexpr const char* kBox = "\"box\": [x, y, z], the whole sizes";
constexpr const char* kSphere = "\"sphere\": {\"radius\": 0.5}";
constexpr const char* kCapsule =
    "\"capsule\": {\"radius\": 0.2, \"length\": 0.6}, the length between the caps' centres";
constexpr const char* kBodies = "\"bodies\": [{...}, {...}]";
constexpr const char* kRate = "\"rate\": 240, steps a second";
constexpr const char* kDuration = "\"duration\": 5, seconds";
constexpr const char* kEye = "\"eye\": [x, y, z] and \"target\": [x, y, z]";
constexpr const char* kFov = "\"fovDegrees\": 40, vertical";
constexpr const char* kSurface = "\"surface\": \"wood\", in a material";
constexpr const char* kLight = "\"light\": \"sunset\", or {\"direction\": [x, y, z], \"exposure\": 1.2}";
constexpr const char* kSet = "\"set\": {\"r\": 0.5}, and then \"=2*r\" in place of a number";
constexpr const char* kRepeat = "\"repeat\": {\"count\": 5, \"step\": [0.3, 0, 0]}";

constexpr std::array kWords = std::to_array<Word>({
    {"friction", kFriction},
    {"mu", kFriction},
    {"frictionCoefficient", kFriction},
    {"kineticFriction", "\"dynamicFriction\": 0.4"},
    {"bounce", kBounce},
    {"bounciness", kBounce},
    {"elasticity", kBounce},
    {"restitution", kMaterialOnly},
    {"density", kMaterialOnly},
    {"staticFriction", kMaterialOnly},
    {"dynamicFriction", kMaterialOnly},
    {"checker", kMaterialOnly},
    {"surface", kMaterialOnly},
    {"surfaceScale", kMaterialOnly},
    {"texture", kSurface},
    {"finish", kSurface},
    {"sun", kLight},
    {"sky", kLight},
    {"lights", kLight},
    {"lighting", kLight},
    {"exposure", "\"light\": {\"exposure\": 1.5}"},
    {"weight", "\"density\", kg/m^3, in a material"},
    {"velocity", kVelocity},
    {"speed", kVelocity},
    {"linear_velocity", kVelocity},
    {"spin", kSpin},
    {"omega", kSpin},
    {"angular_velocity", kSpin},
    {"pos", kPosition},
    {"location", kPosition},
    {"translation", kPosition},
    {"center", kPosition},
    {"origin", kPosition},
    {"orientation", kRotation},
    {"quaternion", "\"rotation\": [w, x, y, z]"},
    {"euler", kRotation},
    {"rpy", kRotation},
    {"angle", "\"degrees\": 45"},
    {"radians", "\"degrees\": 45"},
    {"fixed", kStatic},
    {"isStatic", kStatic},
    {"dynamic", kStatic},
    {"type", kShape},
    {"geometry", kShape},
    {"box", kShape},
    {"sphere", kShape},
    {"size", kShape},
    {"dimensions", kShape},
    {"radius", kShape},
    {"halfExtents", kBox},
    {"cube", kBox},
    {"cuboid", kBox},
    {"ball", kSphere},
    {"pill", kCapsule},
    {"plane", "\"box\": [20, 20, 1] with \"static\": true, half a metre below"},
    {"ground",
     "a body {\"name\": \"floor\", \"shape\": {\"box\": [20, 20, 1]}, \"position\": [0, 0, -0.5], "
     "\"static\": true}"},
    {"floor",
     "a body {\"name\": \"floor\", \"shape\": {\"box\": [20, 20, 1]}, \"position\": [0, 0, -0.5], "
     "\"static\": true}"},
    {"polyhedron", "\"hull\": {\"points\": [[x, y, z], ...]}"},
    {"convex", "\"hull\": {\"points\": [[x, y, z], ...]}"},
    {"diameter", "\"radius\": half of it"},
    {"height", "\"length\""},
    {"colour", "\"color\": \"#rrggbb\""},
    {"objects", kBodies},
    {"entities", kBodies},
    {"rigidBodies", kBodies},
    {"camera", "\"cameras\": {\"main\": {\"eye\": [6, -9, 5], \"target\": [0, 0, 1]}}"},
    {"timestep", kRate},
    {"timeStep", kRate},
    {"dt", kRate},
    {"fps", kRate},
    {"time", kDuration},
    {"length", kDuration},
    {"endTime", kDuration},
    {"lookAt", kEye},
    {"up", "the camera without it: z is up"},
    {"fov", kFov},
    {"fieldOfView", kFov},
    {"copies", kRepeat},
    {"number", kRepeat},
    {"n", kRepeat},
    {"spacing", "\"step\": [x, y, z]"},
    {"offset", "\"step\": [x, y, z]"},
    {"variables", kSet},
    {"vars", kSet},
    {"define", kSet},
    {"water", "\"fluids\": [{\"name\": \"pool\", \"level\": 0}]"},
    {"wind", "\"air\": {\"wind\": [x, y, z]}"},
    {"title", "\"description\": \"...\""},
    {"id", "\"name\": \"...\""},
});

/// Of the colours that people name; those of CSS.
constexpr std::array kColors = std::to_array<Word>({
    {"black", "#000000"},
    {"white", "#ffffff"},
    {"gray", "#808080"},
    {"grey", "#808080"},
    {"red", "#ff0000"},
    {"green", "#008000"},
    {"blue", "#0000ff"},
    {"yellow", "#ffff00"},
    {"orange", "#ffa500"},
    {"brown", "#a52a2a"},
    {"purple", "#800080"},
    {"pink", "#ffc0cb"},
    {"cyan", "#00ffff"},
    {"gold", "#ffd700"},
    {"magenta", "#ff00ff"},
    {"silver", "#c0c0c0"},
});

/// Of a member; none of an item, which is not what its list's key wants.
std::string lastKey(const std::string& path) {
  if (path.ends_with(']')) return "";
  return path.substr(path.rfind('.') == std::string::npos ? 0 : path.rfind('.') + 1);
}

std::optional<double> numberIn(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  const bool is_sum = std::string(rest, end).find_first_of("+-*/^(%") != std::string::npos;
  if (error != std::errc() || !std::isfinite(value) || is_sum) return std::nullopt;
  return value;
}

std::string threeOf(double value) {
  const std::string one = plainNumber(value);
  return "[" + one + ", " + one + ", " + one + "]";
}

/// {"x": 1, "y": 2, "z": 3} as a list.
std::string listOf(const Json& object) {
  std::string list;
  for (const char* axis : {"x", "y", "z"}) {
    const Json* value = object.find(axis);
    list += (list.empty() ? "[" : ", ") + (value == nullptr ? std::string("0") : value->shown());
  }
  return list + "]";
}

bool isVectorKey(const std::string& key) {
  for (const char* known : {"position", "linearVelocity", "angularVelocity", "gravity", "eye", "target",
                            "step", "axis", "wind", "flow", "min", "max", "direction"})
    if (key == known) return true;
  return false;
}

std::string colorText(const Json& value) {
  if (value.kind() == Json::Kind::kString) {
    const std::string& text = value.asString();
    for (const Word& color : kColors)
      if (text == color.tried) return std::string("\"") + color.remedy + "\"";
    if (text.size() == 4 && text[0] == '#')
      return std::string("\"#") + text[1] + text[1] + text[2] + text[2] + text[3] + text[3] + "\"";
    if (text.size() == 6) return "\"#" + text + "\"";
    return "\"#cc4422\", two hexadecimal digits each of red, green and blue";
  }
  return "\"#cc4422\", two hexadecimal digits each of red, green and blue";
}

std::string rgbText(const Json& list) {
  std::string text = "\"#";
  if (list.items().size() != 3) return colorText(list);
  double most = 0.0;
  for (const Json& item : list.items()) {
    if (item.kind() != Json::Kind::kNumber) return colorText(list);
    most = std::max(most, item.asNumber());
  }
  for (const Json& item : list.items()) {
    char digits[8];
    const double share = item.asNumber() / (most > 1.0 ? 255.0 : 1.0);
    std::snprintf(digits, sizeof digits, "%02x",
                  static_cast<unsigned>(std::min(1.0, std::max(0.0, share)) * 255.0 + 0.5));
    text += digits;
  }
  return text + "\"";
}

std::string shapeRemedy(const std::string& key, const Json& value) {
  const bool is_number = value.kind() == Json::Kind::kNumber;
  if (key == "sphere" && value.kind() != Json::Kind::kObject)
    return is_number ? "{\"radius\": " + value.shown() + "}" : "{\"radius\": 0.5}";
  if (key == "capsule" || key == "cylinder")
    if (value.kind() != Json::Kind::kObject) return "{\"radius\": 0.2, \"length\": 0.6}";
  if (key == "cone" && value.kind() != Json::Kind::kObject) return "{\"radius\": 0.2, \"height\": 0.6}";
  if (key == "roundedBox" && value.kind() != Json::Kind::kObject)
    return "{\"size\": [1, 1, 1], \"radius\": 0.1}";
  if (key == "box" || key == "wedge") {
    const bool is_length = is_number && value.asNumber() >= kLength.low && value.asNumber() <= kLength.high;
    if (is_number) return is_length ? threeOf(value.asNumber()) : "[1, 1, 1]";
    if (value.kind() == Json::Kind::kObject) {
      if (const Json* size = value.find("size")) return size->shown();
      return value.find("x") != nullptr ? listOf(value) : "[1, 1, 1]";
    }
  }
  if ((key == "mesh" || key == "hull") && value.kind() == Json::Kind::kString)
    return "{\"file\": " + value.shown() + "}";
  if (key == "shape" && value.kind() == Json::Kind::kString) {
    const std::string& kind = value.asString();
    if (kind == "sphere" || kind == "ball") return "{\"sphere\": {\"radius\": 0.5}}";
    if (kind == "capsule" || kind == "cylinder")
      return "{\"" + kind + "\": {\"radius\": 0.2, \"length\": 0.6}}";
    return "{\"box\": [1, 1, 1]}";
  }
  return "";
}

std::string listRemedy(const std::string& key, const Json& value) {
  if (key == "bodies" && value.kind() == Json::Kind::kObject)
    return "a list: [{\"name\": ..., \"shape\": ...}, ...]";
  if (key == "fluids" && value.kind() == Json::Kind::kObject)
    return "a list: [{\"name\": \"pool\", \"level\": 0}]";
  if (key == "materials" && value.kind() == Json::Kind::kArray)
    return "an object by name: {\"wood\": {\"density\": 600}}";
  if (key == "cameras" && value.kind() == Json::Kind::kArray)
    return "an object by name: {\"main\": {\"eye\": [6, -9, 5], \"target\": [0, 0, 1]}}";
  if (key == "repeat" && value.kind() == Json::Kind::kNumber)
    return "{\"count\": " + value.shown() + ", \"step\": [1, 0, 0]}";
  return "";
}

std::string valueRemedy(const std::string& key, const Json& value, const std::string& message) {
  using Kind = Json::Kind;
  if (value.kind() == Kind::kNull) return "a value, or leave the key out";
  const std::string shape = shapeRemedy(key, value);
  if (!shape.empty()) return shape;
  const std::string list = listRemedy(key, value);
  if (!list.empty()) return list;
  if (key == "color") return value.kind() == Kind::kArray ? rgbText(value) : colorText(value);
  if (key == "gravity" && value.kind() == Kind::kNumber)
    return "[0, 0, " + plainNumber(-std::abs(value.asNumber())) + "]";
  if (key == "rotation") {
    if (value.kind() == Kind::kNumber) return "{\"axis\": [0, 0, 1], \"degrees\": " + value.shown() + "}";
    return "{\"axis\": [0, 0, 1], \"degrees\": 45}";
  }
  if (isVectorKey(key)) {
    if (value.kind() == Kind::kObject) return listOf(value);
    if (message.find("accepted: three") != std::string::npos || value.kind() == Kind::kNumber)
      return "[x, y, z]";
  }
  if (key == "static" || key == "checker" || key == "fit") {
    if (message.find("true or false") != std::string::npos) return "true, without quotes";
  }
  if (value.kind() == Kind::kString && message.find("a finite number") != std::string::npos) {
    if (const std::optional<double> number = numberIn(value.asString()))
      return plainNumber(*number) + ", without quotes or unit; arithmetic begins with =";
    return "a number; arithmetic begins with =: \"=" + value.asString() + "\"";
  }
  return "";
}

}  // namespace

std::string remedyFor(const Json& value, const std::string& message) {
  const std::string key = lastKey(value.path());
  if (message.find("unknown key \"" + key + "\"") != std::string::npos) {
    // A word may be a key elsewhere; what is meant depends on where it stands.
    const bool in_pattern = value.path().find(".repeat.") != std::string::npos;
    for (const Word& word : kWords)
      if (key == word.tried) {
        const bool is_of_scene = word.remedy == kDuration && value.path() != key;
        const bool is_of_repeat = key == "offset" && !in_pattern;
        return is_of_scene || is_of_repeat ? "" : std::string("; write ") + word.remedy;
      }
    return "";
  }
  if (message.find("key \"format\" is missing") != std::string::npos) return "; write \"format\": 1 first";
  if (message.find("key \"shape\" is missing") != std::string::npos) return std::string("; write ") + kShape;
  if (message.find("key \"name\" is missing") != std::string::npos) return "; write \"name\": \"crate\"";
  if (message.find("key \"bodies\" is missing") != std::string::npos)
    return std::string("; write ") + kBodies;
  if (message.find("key \"step\" is missing") != std::string::npos ||
      message.find("key \"count\" is missing") != std::string::npos)
    return value.path().find("repeat") == std::string::npos ? "" : std::string("; write ") + kRepeat;
  if (message.find("key \"radius\" is missing") != std::string::npos) return "; write \"radius\": 0.5";
  if (message.find("key \"length\" is missing") != std::string::npos) return "; write \"length\": 0.6";
  if (message.find("key \"target\" is missing") != std::string::npos ||
      message.find("key \"eye\" is missing") != std::string::npos)
    return std::string("; write ") + kEye;
  const std::string remedy = valueRemedy(key, value, message);
  return remedy.empty() ? "" : "; write " + remedy;
}

std::string syntaxRemedy(const std::string& message) {
  const auto has = [&message](const char* part) { return message.find(part) != std::string::npos; };
  if (has("unexpected ']'") || has("unexpected '}'")) return "; is there a comma too many before it?";
  if (has("unexpected string literal") || has("unexpected '{'") || has("unexpected '['") ||
      has("unexpected number literal"))
    return "; is a comma or a colon missing before it?";
  if (has("unexpected end of input")) return "; is a bracket not closed?";
  if (has("invalid literal")) return "; keys and texts stand in \"double quotes\", and it is true, not True";
  if (has("invalid number")) return "; write 0.5, not .5 or 5.";
  if (has("control character")) return "; a text ends on its line";
  return "";
}

}  // namespace carom::demos
