#include "demos/language/scene_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "demos/format/nearest_name.h"
#include "engine/foundation/elementary.h"

namespace carom::demos {
namespace {

constexpr double kUnitTolerance =
    1e-3;  // a quaternion farther from length one than this is a mistake, not rounding
using std::numbers::pi;

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

Quat readAxisRotation(const Json& json) {
  json.onlyKeys({"axis", "degrees"});
  const Vec3 axis = readVec3(json.at("axis"), kCoordinate);
  if (!(axis.norm() > kSmallestLength_m))
    json.at("axis").fail(json.at("axis").shown() + " has no direction; accepted: an axis of some length");
  const double radians = readNumber(json.at("degrees"), {-36000.0, 36000.0}) * pi / 180.0;
  return rotationBy(axis.normalized() * radians);
}

}  // namespace

std::string plainNumber(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string shown(const Range& range) {
  if (std::isinf(range.high)) return (range.low_open ? "above " : "at least ") + plainNumber(range.low);
  return (range.low_open ? "above " : "") + plainNumber(range.low) + " to " + plainNumber(range.high);
}

double readNumber(const Json& json, const Range& range) {
  const double value = json.asNumber();
  const bool inside = value >= range.low && value <= range.high && !(range.low_open && value == range.low);
  if (!inside) json.fail(json.shown() + " is out of range; accepted: " + shown(range));
  return value;
}

int readWhole(const Json& json, int least, int most) {
  const double value = json.asNumber();
  if (!(value >= least && value <= most) || value != std::floor(value))
    json.fail(json.shown() + " is out of range; accepted: a whole number from " + std::to_string(least) +
              " to " + std::to_string(most));
  return static_cast<int>(value);
}

Vec3 readVec3(const Json& json, const Range& range) {
  if (json.items().size() != 3)
    json.fail(json.shown() + " has " + std::to_string(json.items().size()) + " numbers; accepted: three");
  return {readNumber(json.items()[0], range), readNumber(json.items()[1], range),
          readNumber(json.items()[2], range)};
}

Place placeOf(const Json& json, const std::filesystem::path& file) {
  return file.string() + ":" + std::to_string(json.line()) + ": " + json.path();
}

// Rotations: {"axis": [x, y, z], "degrees": d} or a quaternion [w, x, y, z].

Quat readRotation(const Json& json) {
  if (json.kind() == Json::Kind::kObject) return readAxisRotation(json);
  if (json.kind() != Json::Kind::kArray || json.items().size() != 4)
    json.fail(
        json.shown() +
        " is no rotation; accepted: {\"axis\": [x, y, z], \"degrees\": d} or a unit quaternion [w, x, y, z]");
  double q[4];
  for (std::size_t i = 0; i < 4; ++i) q[i] = json.items()[i].asNumber();
  const Quat rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1.0) <= kUnitTolerance))
    json.fail(json.shown() + " has length " + plainNumber(rotation.norm()) +
              "; accepted: a unit quaternion [w, x, y, z]");
  return rotation.normalized();
}

Pose readPose(const Json& json) {
  Pose pose;
  if (const Json* position = json.find("position")) pose.position = readVec3(*position, kCoordinate);
  if (const Json* rotation = json.find("rotation")) pose.rotation = readRotation(*rotation);
  return pose;
}

// Colours: "#rrggbb".

renderer::Color readColor(const Json& json) {
  const std::string& text = json.asString();
  bool valid = text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; valid && i < 7; ++i) valid = hexDigit(text[i]) >= 0;
  if (!valid) json.fail(json.shown() + " is no colour; accepted: \"#rrggbb\"");
  float channel[3];
  for (std::size_t i = 0; i < 3; ++i)
    channel[i] = static_cast<float>(16 * hexDigit(text[1 + 2 * i]) + hexDigit(text[2 + 2 * i])) / 255.0f;
  return {channel[0], channel[1], channel[2]};
}

namespace {

/// The text, which must be one of the names.
const std::string& readName(const Json& json, const std::vector<std::string>& names) {
  const std::string& name = json.asString();
  if (std::find(names.begin(), names.end(), name) == names.end())
    json.fail(json.shown() + " is unknown" + acceptedNames(name, names));
  return name;
}

Vec3 readLinear(const Json& json) {
  const renderer::Color color = readColor(json);
  return {renderer::linearLight(color.r), renderer::linearLight(color.g), renderer::linearLight(color.b)};
}

/// Another sky gives other light, colour by colour.
void readSky(const Json& json, renderer::Light& light) {
  const Vec3 before = light.horizon + light.zenith;
  if (const Json* value = json.find("horizon")) {
    light.horizon = readLinear(*value);
    light.below = 0.7 * light.horizon;
  }
  if (const Json* value = json.find("zenith")) light.zenith = readLinear(*value);
  light.sky_light = light.sky_light.cwiseProduct((light.horizon + light.zenith).cwiseQuotient(before));
  if (const Json* value = json.find("skyStrength")) {
    const double strength = readNumber(*value, {0.0, 20.0});
    light.sky_light *= strength;
    light.ground_light *= strength;
  }
}

}  // namespace

SurfaceLook readLook(const Json& material) {
  SurfaceLook look;
  if (const Json* value = material.find("color")) {
    look.color = readColor(*value);
    look.has_color = true;
  }
  if (const Json* value = material.find("checker")) look.checker = value->asBoolean();
  if (const Json* value = material.find("ground")) {
    look.checker = true;
    look.pattern = *renderer::groundOf(readName(*value, renderer::groundNames()));
  }
  if (const Json* value = material.find("surface")) {
    look.surface = *renderer::surfaceOf(readName(*value, renderer::surfaceNames()));
    if (look.checker) value->fail("given together with \"ground\" or \"checker\"; accepted: one of them");
  }
  if (const Json* value = material.find("surfaceScale")) {
    look.surface_scale_m = readNumber(*value, {1e-4, 1e4});
    if (look.surface == renderer::SurfaceKind::kPlain)
      value->fail("there is no \"surface\" to scale; accepted: with one of them");
  }
  return look;
}

SceneLight readLight(const Json& json) {
  if (json.kind() == Json::Kind::kString) {
    const std::string& name = readName(json, renderer::lightNames());
    return {name, false, renderer::lightOf(name)};
  }
  json.onlyKeys(
      {"like", "direction", "color", "strength", "softness", "horizon", "zenith", "skyStrength", "exposure"});
  SceneLight scene;
  scene.changed = true;
  if (const Json* value = json.find("like")) scene.name = readName(*value, renderer::lightNames());
  renderer::Light& light = scene.light;
  light = renderer::lightOf(scene.name);
  if (const Json* value = json.find("direction")) {
    light.to_light = readVec3(*value, kCoordinate);
    if (!(light.to_light.norm() > kSmallestLength_m))
      value->fail(value->shown() + " has no direction; accepted: a vector of some length, towards the sun");
  }
  if (const Json* value = json.find("color")) light.sun = light.sun.maxCoeff() * readLinear(*value);
  if (const Json* value = json.find("strength")) light.sun *= readNumber(*value, {0.0, 20.0});
  if (const Json* value = json.find("softness")) light.softness = readNumber(*value, {0.0, 20.0});
  readSky(json, light);
  if (const Json* value = json.find("exposure")) light.exposure = readNumber(*value, kExposure);
  return scene;
}

std::vector<renderer::Color> readColors(const Json& json) {
  if (json.kind() != Json::Kind::kArray) return {readColor(json)};
  std::vector<renderer::Color> colors;
  for (const Json& item : json.items()) colors.push_back(readColor(item));
  if (colors.empty()) json.fail("the list of colours is empty");
  return colors;
}

}  // namespace carom::demos
