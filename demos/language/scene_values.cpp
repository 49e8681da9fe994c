#include "demos/language/scene_values.h"

#include <cmath>
#include <numbers>
#include <sstream>

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

std::vector<renderer::Color> readColors(const Json& json) {
  if (json.kind() != Json::Kind::kArray) return {readColor(json)};
  std::vector<renderer::Color> colors;
  for (const Json& item : json.items()) colors.push_back(readColor(item));
  if (colors.empty()) json.fail("the list of colours is empty");
  return colors;
}

}  // namespace carom::demos
